#pragma once

#include <vector>

#include "server/watcher.hpp"
#include "storage/alerts.hpp"
#include "storage/rules.hpp"

namespace raywatch {

/// Brings the tracks of a site up to one scan, and judges them, inside one transaction.
class TrackKeeper {
 public:
  struct Options {
    Duration moved_within{};
    Time now;
  };
  TrackKeeper(Transaction& transaction, const WatchedComparison& watched, const WatchedScan& turn, const Glance& glance,
              const Options& options)
      : transaction_(transaction), watched_(watched), turn_(turn), glance_(glance), options_(options) {}

  void run();

 private:
  struct Told {
    TrackRecord record;
    Sight sight;
  };

  void follow(TrackRecord record, const std::vector<std::size_t>& changes);
  void begin(const std::vector<std::size_t>& changes);
  void link_to_other_place(const TrackRecord& record);
  void assign(const std::vector<std::size_t>& changes, TrackId track);
  void assign_other_comparisons();
  void judge_told();
  void apply(const AlertStep& step);
  void open_alert_about(const Track& track, const AlertStep& step);
  void add_event(const std::string& type, const Track& track, const std::string& text);

  Transaction& transaction_;
  const WatchedComparison& watched_;
  const WatchedScan& turn_;
  const Glance& glance_;
  Options options_;
  std::vector<Told> told_;  ///< the tracks that this scan told something about
};

}  // namespace raywatch
