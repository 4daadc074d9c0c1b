#pragma once

#include "core/survey.hpp"
#include "storage/survey_files/survey_document.hpp"
#include "tests/simulator/simulated_scan.hpp"

namespace raywatch {

/// A blast in a simulated pit, surveyed by two stations on two nights: what the files of surveys are tried with.
class PitSurvey {
 public:
  explicit PitSurvey(std::uint32_t azimuth_steps = 160);

  const EpochScans& before() const { return before_; }
  const EpochScans& after() const { return after_; }
  SurveyResult result;

  SurveyDocument document(const OutputFrame& frame = {}) const;

 private:
  struct Taken {
    simulator::SimulatedScan scan;
    PriorIndex index;
  };
  std::vector<std::unique_ptr<Taken>> taken_;
  EpochScans before_, after_;
};

}  // namespace raywatch
