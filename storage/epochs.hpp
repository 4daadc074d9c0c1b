#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/survey_ids.hpp"
#include "core/time.hpp"
#include "storage/page.hpp"
#include "storage/scans.hpp"
#include "storage/store.hpp"

namespace raywatch {

enum class EpochState : std::uint8_t {
  usable,
  accepted,  ///< by somebody, as a state that later ones are compared with
  refused,   ///< its scans are not registered well enough: nothing is compared with it
};
std::string_view to_string(EpochState state);

struct EpochAcceptance {
  std::string by, note;
  Time at;
};

/// The scans of one or several stations within a time window.
struct EpochRecord {
  EpochId id;
  SiteId site;
  std::optional<ScheduleId> schedule;
  std::string name;
  Time from, to;              ///< the window: from <= captured_at < to
  std::vector<ScanId> scans;  ///< by capture; some may have been deleted since
  EpochState state = EpochState::usable;
  std::string why;  ///< it was refused
  std::optional<EpochAcceptance> accepted;
  Time created_at;
};

/// The usable scans of a site within a window, of some sensors or of all, for an epoch: of each vantage the latest
/// `kMostScansOfVantage`, in all at most `kMostScansOfEpoch`, by capture; of a window with very many scans those among
/// the latest `kMostScansLookedAt`. A scan that is still compared is among them.
struct EpochWindow {
  SiteId site;
  Time from, to;  ///< from <= captured_at < to
  std::vector<SensorId> sensors = {};
};
inline constexpr std::size_t kMostScansOfVantage = 4, kMostScansOfEpoch = 64, kMostScansLookedAt = 20'000;
std::vector<ScanRecord> scans_of_window(const Snapshot& snapshot, const EpochWindow& window);
/// Whether a scan of the window waits to be compared, so that its registration is not known yet.
bool is_window_unsettled(const Snapshot& snapshot, const EpochWindow& window);

/// Its id and created_at are decided here. @throws NotFound for the site.
EpochRecord insert_epoch(Transaction& transaction, const EpochRecord& epoch, Time now);
std::optional<EpochRecord> find_epoch(const Snapshot& snapshot, EpochId id);
/// Those whose window ended last first.
Page<EpochRecord> list_epochs(const Snapshot& snapshot, std::optional<SiteId> site, const PageRequest& page);
/// @throws Conflict when it was refused.
EpochRecord accept_epoch(Transaction& transaction, EpochId id, const EpochAcceptance& acceptance);
/// @throws Conflict while a schedule is compared with it, or a run that is not finished needs it.
void delete_epoch(Transaction& transaction, EpochId id);

/// Which epochs may stand for an earlier state.
struct EpochSearch {
  SiteId site;
  std::optional<ScheduleId> schedule;  ///< of it only
  Time until;                          ///< its window ended then or earlier
  bool accepted = false;               ///< only accepted ones
  std::optional<Time> from = {};       ///< its window ended later than this
};
/// The latest that was not refused.
std::optional<EpochRecord> latest_epoch(const Snapshot& snapshot, const EpochSearch& search);

/// The scans that surveys of a site still need: those of accepted epochs, of what schedules compare with next, and of
/// runs that are not finished.
std::vector<ScanId> scans_that_surveys_need(const Snapshot& snapshot, SiteId site);
/// Whether an accepted epoch has the scan.
bool is_in_accepted_epoch(const Snapshot& snapshot, ScanId scan);

}  // namespace raywatch
