#pragma once

#include <map>
#include <string>

#include "tests/evaluate/causes.hpp"
#include "tests/evaluate/picture.hpp"

namespace raywatch::evaluation {

/// Keeps one picture of each kind of error: of the place where most errors of it lie together. Each shows a part of
/// the panorama of the scan that holds the points: grey what stays (darker: nearer), green changed points that were
/// found, orange ones that were missed, red ones that are false; errors of other causes are paler.
class Gallery {
 public:
  void add(const CaseViews& views, const CaseLabels& labels, const Verdicts& verdicts,
           const std::vector<PointError>& errors);
  /// Writes CAUSE-false.png and CAUSE-missed.png for every kind that occurred. Creates the folder.
  void write(const std::filesystem::path& folder) const;

 private:
  struct Exhibit {
    std::size_t errors = 0;
    Picture picture;
  };
  std::map<std::string, Exhibit> exhibits_;
};

}  // namespace raywatch::evaluation
