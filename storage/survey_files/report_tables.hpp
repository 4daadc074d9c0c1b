#pragma once

#include <string>

#include "storage/survey_files/survey_document.hpp"

namespace raywatch {

// The tables of a report, as HTML.

std::string zones_table(const SurveyDocument& document);
/// The largest by volume, at most `kMostReportedChanges`.
std::string changes_table(const SurveyDocument& document);
inline constexpr std::size_t kMostReportedChanges = 40;
/// How well the scans are registered.
std::string registration_table(const SurveyDocument& document);
/// What the figures rest on: scans with their hashes, parameters, version.
std::string basis_tables(const SurveyDocument& document);

}  // namespace raywatch
