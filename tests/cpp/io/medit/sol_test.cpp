// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "io/files.h"
#include "io/medit/sol_files.h"
#include "io_test_support.h"

namespace carreau {
namespace {

std::string error_of(std::string_view text) {
  return sentence_of<FileError>([&] { read_solution_text(text, "x.sol"); });
}
std::string binary_error_of(std::string_view bytes) {
  return sentence_of<FileError>([&] { read_solution_binary(bytes, "x.solb"); });
}

const std::string header = "MeshVersionFormatted 2\nDimension 3\n";

/// Two vertices of scalars or of tensors of the plane, in any version and order of bytes, after a section of no use.
std::string binary_file(int version, bool big_endian, bool tensor) {
  Bytes b(big_endian);
  const std::int64_t position = version >= 3 ? 8 : 4, count = version == 4 ? 8 : 4, real = version == 1 ? 4 : 8;
  const auto section = [&](std::int64_t code, std::int64_t content) {
    const std::int64_t next = code == 54 ? 0 : b.size() + 4 + position + content;
    b.i32(code);
    position == 8 ? b.i64(next) : b.i32(next);
  };
  const int values = tensor ? 6 : 2;
  b.i32(1).i32(version);
  section(3, 4);
  b.i32(2);
  section(66, 8);  // not looked at
  b.f64(1);
  section(62, count + 8 + values * real);
  count == 8 ? b.i64(2) : b.i32(2);
  b.i32(1).i32(tensor ? 3 : 1);
  for (int i = 0; i < values; ++i) real == 4 ? b.f32(static_cast<float>(i) + 0.5F) : b.f64(i + 0.5);
  section(54, 0);
  return b.text();
}

TEST(Solution, TextOfAScalarAVertexIsRead) {
  const Solution s = read_solution_text(
      "MeshVersionFormatted 2 # comment\nDimension\n2\nSolAtVertices 3\n1 1\n0.5 1d-3\n+2\nTime 7\nEnd\n", "x.sol");
  EXPECT_EQ(s, (Solution{.dimension = 2, .tensor = false, .values = {0.5, 1e-3, 2}}));
}

TEST(Solution, TextOfATensorAVertexIsReadInTheOrderOfTheLowerTriangle) {
  const Solution s = read_solution_text(header + "SolAtVertices\n1\n1 3\n1 2 3 4 5 6\nEnd", "x.sol");
  EXPECT_EQ(s, (Solution{.dimension = 3, .tensor = true, .values = {1, 2, 3, 4, 5, 6}}));
  EXPECT_EQ(s.count(), 1u);
}

TEST(Solution, FieldsOfSeveralTypesAreReadAndWritten) {
  const Solution fields{.dimension = 2,
                        .tensor = false,
                        .values = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20},
                        .fields = {ValueType::scalar, ValueType::vector, ValueType::symmetric, ValueType::full}};
  EXPECT_EQ(fields.components(), 10u);
  EXPECT_EQ(fields.count(), 2u);
  EXPECT_EQ(read_solution_text(solution_text(fields), "x.sol", SolutionUse::fields), fields);
  EXPECT_EQ(read_solution_binary(solution_bytes(fields), "x.solb", SolutionUse::fields), fields);
  const Solution space = read_solution_text(header + "SolAtVertices\n1\n3 2 1 3\n1 2 3 4 5 6 7 8 9 10\nEnd", "x.sol",
                                            SolutionUse::fields);
  EXPECT_EQ(space.components(), 10u);
  EXPECT_EQ(space.count(), 1u);
}

TEST(Solution, ListsOfTypesWithoutSenseAreRejected) {
  const auto refused = [](const std::string& text) {
    return sentence_of<FileError>([&] { read_solution_text(header + text, "x.sol", SolutionUse::fields); });
  };
  EXPECT_NE(refused("SolAtVertices 1\n0\nEnd").find("x.sol, line 4: there are 0 values at each vertex; 1 to 64 are required"),
            std::string::npos);
  EXPECT_NE(refused("SolAtVertices 1\n65\nEnd").find("there are 65 values"), std::string::npos);
  EXPECT_NE(refused("SolAtVertices 1\n2 1 5\n1 2\nEnd").find("type 5 is not 1"), std::string::npos);
  EXPECT_NE(refused("SolAtVertices 2\n1 2\n1 2 3\nEnd"), "");
}

TEST(Solution, BinaryVersions1To4AreReadInBothByteOrders) {
  for (int version = 1; version <= 4; ++version)
    for (const bool big_endian : {false, true})
      for (const bool tensor : {false, true}) {
        const Solution s = read_solution_binary(binary_file(version, big_endian, tensor), "x.solb");
        EXPECT_EQ(s.dimension, 2);
        EXPECT_EQ(s.tensor, tensor);
        ASSERT_EQ(s.count(), 2u);
        for (std::size_t i = 0; i < s.values.size(); ++i) EXPECT_EQ(s.values[i], static_cast<double>(i) + 0.5);
      }
}

TEST(Solution, BothFormsRestoreWrittenValues) {
  std::mt19937_64 random(3);
  const TemporaryFolder folder;
  for (int round = 0; round < 40; ++round) {
    Solution s{.dimension = round % 2 + 2, .tensor = round % 4 > 1, .values = {}};
    for (std::size_t i = random() % 20 * s.components(); i > 0; --i) s.values.push_back(random_double(random));
    const CommaLocale comma;
    for (const char* name : {"x.sol", "x.solb", "x.SOL", "x.SolB"}) {
      write_solution(s, folder.file(name));
      EXPECT_EQ(read_solution(folder.file(name)), s);
    }
  }
}

TEST(Solution, EveryTruncationIsAnErrorButOfEnd) {
  const std::string text = solution_text({.dimension = 2, .tensor = true, .values = {1, 0, 2, 3, 0, 4}});
  const std::size_t whole = text.find("End") + 3;
  for (std::size_t n = 0; n < whole; ++n) EXPECT_EQ(error_of(text.substr(0, n)) == "", n == whole - 3 || n == whole - 4) << n;
  for (int version = 1; version <= 4; ++version) {
    const std::string bytes = binary_file(version, false, true);
    for (std::size_t n = 0; n < bytes.size(); ++n) EXPECT_NE(binary_error_of(bytes.substr(0, n)), "") << n;
  }
}

TEST(Solution, SkipsSectionsOfOtherPrograms) {
  const Solution s = read_solution_text(
      header + "MyProgram \"a name\" 3\n1 2 3\nSolAtVertices 2\n1 1\n1 2\nIterationsDone\n4\n", "x.sol");
  EXPECT_EQ(s.values, (std::vector<double>{1, 2}));
}

TEST(Solution, NamesTheLineOfEveryViolation) {
  EXPECT_EQ(error_of(""), "x.sol, line 1: the file is empty");
  EXPECT_EQ(error_of("\nsolid"), "x.sol, line 2: a solution file starts with MeshVersionFormatted, not with 'solid'");
  EXPECT_EQ(error_of(header + "End"), "x.sol, line 3: the file has no SolAtVertices");
  EXPECT_EQ(error_of("MeshVersionFormatted 2\nSolAtVertices 0 1 1"),
            "x.sol, line 2: SolAtVertices comes before Dimension");
  EXPECT_EQ(error_of(header + "SolAtVertices 1\n1 1\n0.5\nSolAtVertices 1 1 1 0.5"),
            "x.sol, line 6: SolAtVertices comes twice");
  EXPECT_EQ(error_of(header + "SolAtVertices 3\n1 1\n1 2\nEnd"),
            "x.sol, line 6: a value should be a number, not 'End'");
  EXPECT_EQ(error_of(header + "SolAtVertices 2\n1 1\n1 2 3\nEnd"),
            "x.sol, line 5: the name of a section or End was expected, not '3'");
  EXPECT_EQ(error_of(header + "SolAtVertices 2\n1 1\n1\nnan\nEnd"), "x.sol, line 6: a value is not finite: 'nan'");
  EXPECT_EQ(error_of(header + "SolAtVertices -1\n1 1\nEnd"), "x.sol, line 3: the number of vertices is negative: -1");
  EXPECT_EQ(error_of(header + "SolAtVertices 1000000000\n1 3\n1 0 1"),
            "x.sol, line 3: 1000000000 vertices are announced, but the rest of the file has room for at most 0");
  EXPECT_EQ(error_of(header + "SolAtVertices 1\n2 1 1\n1 2\nEnd"),
            "x.sol, line 4: there are 2 values at each vertex (1 scalar, 2 scalar); one size, field or metric is required, which the "
            "parameter sol_field chooses");
  EXPECT_EQ(error_of(header + "SolAtVertices 1\n1 2\n1 2 3\nEnd"),
            "x.sol, line 4: the values are vectors (type 2); scalars (1) or symmetric tensors (3) are required");
  EXPECT_EQ(error_of(header + "SolAtVertices 1\n1 7\n1\nEnd"),
            "x.sol, line 4: type 7 is not 1 (scalar), 2 (vector), 3 (symmetric tensor) or 4 (tensor)");
  EXPECT_EQ(error_of(header + "SolAtVertex 1\n1 1\n1\nEnd"), "x.sol, line 6: the file has no SolAtVertices");
  EXPECT_EQ(error_of(header + "SolutionAtVertices 1\n1 1\n1\nEnd"), "x.sol, line 6: the file has no SolAtVertices");
  EXPECT_EQ(error_of(header + "SolAtVertices 1\n1 1\n1\nEn"),
            "x.sol, line 6: the file ends without the word End: it may be truncated");
}

TEST(Solution, NamesTheByteOfEveryViolation) {
  const std::string start = Bytes().i32(1).i32(2).i32(3).i32(20).i32(3).text();
  const auto after = [&](const Bytes& b) { return binary_error_of(start + b.text()); };
  EXPECT_EQ(after(Bytes().i32(54).i32(0)), "x.solb: byte 28: the file has no solution at vertices");
  EXPECT_EQ(after(Bytes().i32(62).i32(48).i32(3).i32(1).i32(1).f64(1)),
            "x.solb: byte 28: 3 values are announced, but there is room for 1");
  EXPECT_EQ(after(Bytes().i32(62).i32(48).i32(1).i32(1).i32(1).f64(std::nan(""))),
            "x.solb: byte 40: a value is not finite");
  EXPECT_EQ(after(Bytes().i32(62).i32(48).i32(1).i32(1).i32(2).f64(1)),
            "x.solb: byte 32: the values are vectors (type 2); scalars (1) or symmetric tensors (3) are required");
  EXPECT_EQ(after(Bytes().i32(62).i32(48).i32(1).i32(2).i32(1).i32(2).f64(1)),
            "x.solb: byte 32: there are 2 values at each vertex (1 scalar, 2 vector); one size, field or metric is required, "
            "which the parameter sol_field chooses");
}

TEST(Solution, OneFieldOfSeveralIsChosen) {
  // A scalar, a vector, a metric and a scalar at each of two vertices: the numbers count from 1.
  const std::string text = "MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n2\n4 1 2 3 1\n"
                           "1 2 3 4 5 6 7 8 9 10 11\n-12 13 14 15 16 0 17 0 0 18 19\nEnd\n";
  const auto chosen = [&](SolutionUse use, int field) { return read_solution_text(text, "x.sol", {use, field}); };
  EXPECT_EQ(chosen(SolutionUse::prescription, 4).values, (std::vector<double>{11, 19}));
  EXPECT_EQ(chosen(SolutionUse::field, 1).values, (std::vector<double>{1, -12}));
  const Solution metric = chosen(SolutionUse::field, 3);
  EXPECT_TRUE(metric.tensor);
  EXPECT_EQ(metric.values, (std::vector<double>{5, 6, 7, 8, 9, 10, 16, 0, 17, 0, 0, 18}));
  const Solution vector = chosen(SolutionUse::fields, 2);
  EXPECT_EQ(vector.fields, (std::vector<ValueType>{ValueType::vector}));
  EXPECT_EQ(vector.values, (std::vector<double>{2, 3, 4, 13, 14, 15}));
  EXPECT_EQ(chosen(SolutionUse::fields, 0).components(), 11u);
  const std::string list = "1 scalar, 2 vector, 3 symmetric tensor, 4 scalar";
  for (const int field : {0, 2, 5}) try {
      chosen(SolutionUse::prescription, field);
      ADD_FAILURE() << field;
    } catch (const FileError& error) {
      EXPECT_NE(std::string(error.what()).find(list), std::string::npos) << error.what();
    }
  // The values of other fields do not count; the chosen ones do.
  EXPECT_THROW(chosen(SolutionUse::prescription, 1), FileError);
}

TEST(Solution, SizesAndMetricsThatCannotBeUsedAreNamedWithTheirPlace) {
  const auto text = [](const std::string& sol) {
    return sentence_of<FileError>([&] { read_solution_text(header + sol, "x.sol", SolutionUse::prescription); });
  };
  EXPECT_EQ(text("SolAtVertices 2\n1 1\n1\n0\nEnd"), "x.sol, line 6: vertex 2 has the size 0, which is not positive");
  EXPECT_EQ(text("SolAtVertices 1\n1 3\n1 2 1\n0 0 1\nEnd"),
            "x.sol, line 6: vertex 1 has a metric that is not positive definite");
  EXPECT_EQ(text("SolAtVertices 1\n1 3\n2 1 2\n0 0 1\nEnd"), "");
  std::string bytes = solution_bytes({.dimension = 2, .tensor = true, .values = {1, 0, 1, 1, 2, 1}});
  EXPECT_EQ(sentence_of<FileError>([&] { read_solution_binary(bytes, "x.solb", SolutionUse::prescription); }),
            "x.solb: byte 64: vertex 2 has a metric that is not positive definite");
  EXPECT_EQ(binary_error_of(bytes), "");
}

TEST(Solution, TensorsComeInTheOrderOfTheLowerTriangle) {
  const Solution s{.dimension = 3, .tensor = true, .values = {0, 0, 0, 0, 0, 0, 11, 12, 22, 13, 23, 33}};
  EXPECT_EQ(space_tensor(s, 1), (Metric3{.xx = 11, .xy = 12, .xz = 13, .yy = 22, .yz = 23, .zz = 33}));
  EXPECT_EQ(plane_tensor({.dimension = 2, .tensor = true, .values = {0, 0, 0, 1, 2, 3}}, 1), (Metric2{1, 2, 3}));
}

TEST(Solution, ValuesThatNoReaderWouldTakeAreNotWritten) {
  const auto refusal = [](const Solution& s) { return sentence_of<InvalidArgument>([&] { solution_text(s); }); };
  EXPECT_EQ(refusal({.dimension = 2, .tensor = true, .values = {1, 2}}),
            "a solution cannot be written: 2 values are not a multiple of 3");
  EXPECT_EQ(refusal({.dimension = 3, .tensor = false, .values = {1, std::nan("")}}),
            "a solution cannot be written: the value at vertex 1 (from 0) is not finite");
  EXPECT_EQ(sentence_of<InvalidArgument>([] { write_solution({}, "x.txt"); }),
            "'x.txt' does not have a suffix of solution files: .sol, .solb");
}

}  // namespace
}  // namespace carreau
