// SPDX-License-Identifier: BSD-3-Clause
// The sections of a report: each is "" if it has no content.
#pragma once

#include <string>

#include "report/report_content.h"

namespace command {

/// The verdict: no problems, or the list of problems.
std::string verdict_section(const ReportContent& content);
/// The elements of least quality, and of largest distance and angle to the surface, with buttons that show them.
std::string worst_section(const ReportContent& content);
std::string histograms_section(const ReportContent& content);
/// A row a face, with a button that shows it.
std::string faces_section(const ReportContent& content);
std::string asked_section(const ReportContent& content);
std::string delivered_section(const ReportContent& content);
/// Warnings of the run, unreadable entities, defects, triangles that cross.
std::string warnings_section(const ReportContent& content);
/// Counts, borders, parts, lengths, angles.
std::string mesh_section(const ReportContent& content);
std::string times_section(const ReportContent& content);
std::string command_section(const ReportContent& content);

}  // namespace command
