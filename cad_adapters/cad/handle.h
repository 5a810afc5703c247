// SPDX-License-Identifier: BSD-3-Clause
// The content of the handle of carreau_cad.h, and the only place where an exception becomes a status.
#pragma once

#include <assembly/face_contacts.h>
#include <assembly/part_tree.h>
#include <brep_host.h>
#include <changes/small_features.h>
#include <face_figures.h>
#include <faults.h>
#include <shape_file.h>
#include <shape_report.h>
#include <solids.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "carreau_cad.h"

struct carreau_cad_file {
  std::shared_ptr<carreau_occ::FaultTrap> trap;  // before what may fault
  carreau_occ::ShapeFile shape;
  std::unique_ptr<carreau_occ::BrepHost> host;  // nullptr: nothing was read
  std::vector<std::pair<int, std::string>> left_out;
  std::optional<std::vector<carreau_occ::FaceFigures>> figures;  // once computed
  std::optional<carreau_occ::ShapeReport> report;                // the last one
  std::vector<std::string> sentences;                            // of its dangers
  std::optional<carreau_occ::Solids> solids;
  std::optional<std::vector<carreau_occ::TreeRow>> tree;
  std::optional<std::vector<carreau_occ::FaceContact>> contacts;
  std::string notes;  // a line each
  bool loose_edges = false;
  std::vector<carreau_occ::SmallFeature> features;
  std::string feature_faces;  // of the last one that was requested
  std::string error;
};

namespace carreau_occ::abi {

struct Failure : std::runtime_error {
  Failure(carreau_status status_of, const std::string& sentence) : std::runtime_error(sentence), status(status_of) {}
  carreau_status status;
};

/// Returns the status of the exception that is being handled, and keeps its sentence in `kept` if there is one.
carreau_status status_of_exception(std::string* kept) noexcept;

/// Runs body() and returns the status of its exception.
template <typename Body>
carreau_status status_of(Body&& body, std::string* kept = nullptr) noexcept {
  try {
    body();
    return CARREAU_OK;
  } catch (...) {
    return status_of_exception(kept);
  }
}

/// The frame of every function that has a file.
template <typename Body>
carreau_status guarded_call(carreau_cad_file* file, Body&& body) noexcept {
  if (file == nullptr) return CARREAU_ERR_ARGUMENT;
  file->error.clear();
  return status_of(body, &file->error);
}

template <typename T>
T* required(T* pointer, const char* name) {
  if (pointer == nullptr) throw Failure(CARREAU_ERR_ARGUMENT, std::string("the argument ") + name + " is NULL");
  return pointer;
}

inline BrepHost& host_of(const carreau_cad_file& file) {
  if (!file.host) throw Failure(CARREAU_ERR_ARGUMENT, "the file holds nothing: call carreau_cad_read first");
  return *file.host;
}

/// Found at the first call.
const Solids& solids_in(carreau_cad_file& file);
const std::vector<FaceContact>& contacts_of(carreau_cad_file& file);

/// Faces of the file, from 1.
inline void check_face(const BrepHost& host, int number) {
  if (number < 1 || number > host.face_count())
    throw Failure(CARREAU_ERR_ARGUMENT, "there is no face " + std::to_string(number) + "; the file has " +
                                            std::to_string(host.face_count()));
}

/// An element of a list that the caller names by its index, from 0.
template <typename T>
const T& at(const std::vector<T>& list, int64_t index, const char* what) {
  if (index < 0 || static_cast<std::uint64_t>(index) >= list.size())
    throw Failure(CARREAU_ERR_ARGUMENT, std::string(what) + " " + std::to_string(index) + " is out of range; there are " +
                                            std::to_string(list.size()));
  return list[static_cast<std::size_t>(index)];
}

template <typename Struct>
std::size_t checked_size(const Struct* given, const char* name) {
  const std::size_t size = required(given, name)->struct_size;
  if (size <= sizeof(std::size_t) || size > 64 * sizeof(Struct))
    throw Failure(CARREAU_ERR_ARGUMENT, std::string(name) + "->struct_size is " + std::to_string(size));
  return size;
}

/// Fills as many members as the caller's struct has.
template <typename Struct>
void write_struct(Struct value, Struct* out, const char* name) {
  const std::size_t size = checked_size(out, name);
  value.struct_size = size;
  std::memcpy(out, &value, std::min(size, sizeof(Struct)));
}

/// The caller's struct as this library knows it: members it does not have are zero; nullptr: all are.
template <typename Struct>
Struct read_struct(const Struct* given, const char* name) {
  Struct known{};
  if (given == nullptr) return known;
  const std::size_t size = checked_size(given, name);
  std::memcpy(&known, given, std::min(size, sizeof(Struct)));
  const auto* bytes = reinterpret_cast<const unsigned char*>(given);
  if (size > sizeof(Struct) && std::any_of(bytes + sizeof(Struct), bytes + size, [](unsigned char b) { return b != 0; }))
    throw Failure(CARREAU_ERR_ARGUMENT,
                  std::string(name) + " has members set that this version of the library does not know");
  return known;
}

}  // namespace carreau_occ::abi
