#pragma once

#include <tbb/task_arena.h>

#include <string>
#include <vector>

#include "core/align.hpp"
#include "core/choose_priors.hpp"
#include "server/scan_loader.hpp"
#include "storage/scans.hpp"
#include "storage/sites.hpp"
#include "storage/store.hpp"

namespace raywatch {

struct RegistrarConfig {
  AlignParameters align;
  /// A fixed sensor whose scans ask for a correction beyond this was moved or has tilted.
  PoseUncertainty fixed_tolerance{.position_m = 0.03, .angle_rad = 0.002};
  std::size_t max_anchors = 2;
};

/// What came of a registration.
struct ScanRegistration {
  Registration registration;
  std::vector<std::string> warnings;
};

/// Refines the poses of scans against the anchors of their site: the earliest scan of each vantage that had nothing to
/// be aligned with when it came, at its pose as reported. Never against scans that were refined themselves: errors
/// would add up from scan to scan.
class ScanRegistrar {
 public:
  ScanRegistrar(Store& store, const ScanLoader& loader, const RegistrarConfig& config)
      : store_(store), loader_(loader), config_(config) {}

  /// @param loaded the scan at its reported pose. Computes in `arena`; must not be called from inside it.
  ScanRegistration operator()(const ScanRecord& scan, const Site& site, const CompareParameters& parameters,
                              const LoadedScan& loaded, tbb::task_arena& arena) const;

 private:
  std::vector<ScanRecord> anchors_of(const ScanRecord& scan, const Site& site, const LoadedScan& loaded,
                                     tbb::task_arena& arena) const;
  ScanRegistration judged(const ScanRecord& scan, const Site& site, const Alignment& found, bool is_fixed) const;

  Store& store_;
  const ScanLoader& loader_;
  RegistrarConfig config_;
};

/// What a comparison must say of a scan's registration; empty when there is nothing to say.
std::vector<std::string> registration_warnings(const ScanRecord& scan);

}  // namespace raywatch
