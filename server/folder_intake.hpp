#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "api/services.hpp"
#include "core/time.hpp"
#include "server/folder_files.hpp"

namespace raywatch {

/// A folder whose scan files are taken in.
struct FolderConfig {
  std::filesystem::path path;
  std::string sensor;   ///< empty: the side-cars name it
  std::string site;     ///< where the sensor must be, when given
  bool create = false;  ///< make the folder, the site and the sensor when they are missing
  TimeFrom time_from = TimeFrom::name;
  std::chrono::milliseconds poll{2000};    ///< looked at this often, besides when the system says that it changed
  std::chrono::milliseconds settle{2000};  ///< a file that did not change for so long is tried
  std::chrono::seconds patience{30};       ///< one that cannot be taken in yet waits so long for the rest of it, or for
                                           ///< its side-car; from its last change
};

/// What became of the files of all folders since the start.
struct FolderStatus {
  std::atomic<std::uint64_t> stored{0}, known{0}, failed{0};
  std::atomic<std::uint64_t> waiting{0};  ///< now
};

/// Takes in the files of one folder, by the same way as uploads. What is done is moved to `done/`, what cannot be taken
/// to `failed/` with `FILE.reason.txt` beside it. Nothing is kept but in the folder itself: after a crash a file that
/// was stored and not moved is found to be stored already.
class FolderIntake {
 public:
  using Clock = std::chrono::steady_clock;
  /// @param ingest as `Commands::ingest`
  FolderIntake(Store& store, FolderConfig config, std::function<UploadResult(const Upload&)> ingest,
               std::function<Time()> now, FolderStatus& status);

  /// Looks once, and takes in what is complete, in the order of capture. One thread at a time.
  /// @returns when to look again at the latest.
  Clock::time_point look(Clock::time_point now);
  /// Says that a file was renamed to this name: it is complete at once.
  void note_renamed(const std::string& name) { renamed_.insert(name); }

  const FolderConfig& config() const { return config_; }

 private:
  /// A file that lies in the folder.
  struct Waiting {
    FileState state;
    std::optional<FileState> side_car;
    Clock::time_point since;  ///< it is as it is
    std::string refused;      ///< why it cannot be taken in as it is; empty: it was not tried
  };
  struct Ready {
    std::filesystem::path file;
    ScanHints hints;
  };

  bool is_usable();
  void make_sensor() const;
  void list_files(Clock::time_point now);
  std::vector<Ready> ready_files(Clock::time_point now);
  ScanHints hints_of(const std::filesystem::path& file) const;
  void take_in_all(const std::vector<Ready>& files, Clock::time_point now);
  void take_in(const Ready& ready, Clock::time_point now);
  bool is_due(const Waiting& entry, Clock::time_point now) const;
  void refuse(const std::filesystem::path& file, const std::string& reason, Clock::time_point now);
  void give_up(const std::filesystem::path& file, const std::string& reason);
  void put_away(const std::filesystem::path& file, const std::filesystem::path& target);
  void adopt_side_cars() const;
  Clock::time_point next_look(Clock::time_point now) const;
  void complain(const std::string& trouble);

  Store& store_;
  const FolderConfig config_;
  const std::filesystem::path done_, failed_;
  std::function<UploadResult(const Upload&)> ingest_;
  std::function<Time()> now_;
  FolderStatus& status_;
  std::map<std::filesystem::path, Waiting> waiting_;
  std::set<std::string> renamed_;
  std::uint64_t counted_waiting_ = 0;
  std::string trouble_;             ///< what was complained about last
  Clock::time_point not_before_{};  ///< nothing is taken in until then: the queue or the disk is full
};

/// The thread that looks into a folder: when the system says that something changed there, and each `poll` besides.
class FolderThread {
 public:
  explicit FolderThread(std::unique_ptr<FolderIntake> intake);

 private:
  std::unique_ptr<FolderIntake> intake_;
  std::jthread thread_;  // last: it uses the other
};

}  // namespace raywatch
