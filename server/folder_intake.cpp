#include "server/folder_intake.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <fstream>
#include <tuple>
#include <utility>

#include "core/error.hpp"
#include "storage/formats/side_car.hpp"
#include "storage/rules.hpp"
#include "storage/sensors.hpp"
#include "storage/sites.hpp"

namespace raywatch {
namespace {

namespace fs = std::filesystem;

/// How long nothing is taken in after the disk was full, or the store failed.
constexpr std::chrono::seconds kIntakeRest{5};

void write_text(const fs::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  out << text << '\n';
  out.close();
  if (!out) throw StorageError(file.string() + " cannot be written");
}

std::string ids_of(const std::vector<ScanRecord>& scans) {
  std::string ids;
  for (const ScanRecord& scan : scans) ids += (ids.empty() ? "scan " : ", ") + std::to_string(scan.id.value);
  return ids;
}

}  // namespace

FolderIntake::FolderIntake(Store& store, FolderConfig config, std::function<UploadResult(const Upload&)> ingest,
                           std::function<Time()> now, FolderStatus& status)
    : store_(store),
      config_(std::move(config)),
      done_(config_.path / "done"),
      failed_(config_.path / "failed"),
      ingest_(std::move(ingest)),
      now_(std::move(now)),
      status_(status) {
  adopt_side_cars();
}

FolderIntake::Clock::time_point FolderIntake::look(Clock::time_point now) {
  if (now < not_before_) return not_before_;
  if (!is_usable()) return now + config_.poll;
  list_files(now);
  take_in_all(ready_files(now), now);
  status_.waiting += waiting_.size() - counted_waiting_;
  counted_waiting_ = waiting_.size();
  return next_look(now);
}

/// What was complained about is only said once, until it is another.
void FolderIntake::complain(const std::string& trouble) {
  if (!trouble.empty() && trouble != trouble_) spdlog::warn("folder {}: {}", config_.path.string(), trouble);
  trouble_ = trouble;
}

bool FolderIntake::is_usable() {
  try {
    if (config_.create) fs::create_directories(config_.path);
    if (!fs::is_directory(config_.path)) {
      complain("there is no such folder; make it, or set create = true");
      return false;
    }
    fs::create_directories(done_);
    fs::create_directories(failed_);
    if (!config_.sensor.empty()) make_sensor();
  } catch (const std::exception& error) {
    complain(error.what());
    return false;
  }
  complain("");
  return true;
}

/// @throws NotFound, Conflict when the sensor is not there, or elsewhere.
void FolderIntake::make_sensor() const {
  const auto check = [&](const Snapshot& snapshot) {
    const std::optional<Sensor> sensor = find_sensor(snapshot, config_.sensor);
    if (!sensor) return false;
    const std::optional<Site> site = find_site(snapshot, sensor->site);
    if (!config_.site.empty() && site && site->name != config_.site) {
      throw Conflict("sensor \"" + config_.sensor + "\" belongs to the site \"" + site->name + "\", not to \"" +
                     config_.site + "\"");
    }
    return true;
  };
  if (store_.read(check)) return;
  if (!config_.create || config_.site.empty()) {
    throw NotFound("there is no sensor \"" + config_.sensor + "\"; make it, or set create = true and site");
  }
  store_.write([&](Transaction& transaction) {
    if (check(transaction)) return;
    std::optional<Site> site = find_site(transaction, config_.site);
    if (!site) {
      Site made;
      made.name = config_.site;
      site = insert_site(transaction, made, now_());
      insert_rule(transaction, default_rule(site->id, site->profile), now_());
    }
    Sensor sensor;
    sensor.name = config_.sensor;
    sensor.site = site->id;
    insert_sensor(transaction, sensor, now_());
  });
}

void FolderIntake::list_files(Clock::time_point now) {
  std::map<fs::path, Waiting> present;
  for (const fs::path& file : scan_files_in(config_.path)) {
    const std::optional<FileState> state = state_of(file);
    if (!state) continue;
    Waiting entry{.state = *state, .side_car = state_of(side_car_of(file)), .since = now, .refused = {}};
    const auto known = waiting_.find(file);
    const bool is_same =
        known != waiting_.end() && known->second.state == entry.state && known->second.side_car == entry.side_car;
    if (is_same) entry = known->second;
    if (renamed_.contains(file.filename().string())) entry.since = std::min(entry.since, now - config_.settle);
    present.emplace(file, std::move(entry));
  }
  renamed_.clear();
  waiting_ = std::move(present);
}

ScanHints FolderIntake::hints_of(const fs::path& file) const {
  ScanHints hints = state_of(side_car_of(file)) ? read_side_car(file) : ScanHints{};
  if (!config_.sensor.empty()) hints.sensor = config_.sensor;
  if (!hints.captured_at) hints.captured_at = time_in_name(file.filename().string());
  if (!hints.captured_at && config_.time_from == TimeFrom::mtime) {
    if (const auto state = state_of(file)) hints.captured_at = Time(Duration(state->modified_ns));
  }
  return hints;
}

bool FolderIntake::is_due(const Waiting& entry, Clock::time_point now) const {
  const Clock::duration unchanged = now - entry.since;
  return unchanged >= config_.settle && (entry.refused.empty() || unchanged >= config_.patience);
}

/// Those that are complete as far as can be told without reading them, in the order of capture.
std::vector<FolderIntake::Ready> FolderIntake::ready_files(Clock::time_point now) {
  std::vector<std::filesystem::path> due;
  for (const auto& [file, entry] : waiting_) {
    if (is_due(entry, now)) due.push_back(file);
  }
  std::vector<Ready> ready;
  for (const fs::path& file : due) {
    try {
      ready.push_back({file, hints_of(file)});
    } catch (const Error& error) {  // the side-car is broken, or not complete
      refuse(file, error.what(), now);
    }
  }
  std::ranges::sort(ready, {},
                    [](const Ready& r) { return std::tuple(r.hints.captured_at.value_or(Time::max()), r.file); });
  return ready;
}

/// What is wrong may yet become right: the file's end or its side-car may come, its sensor may be made. Once patience
/// is over it is tried a last time.
void FolderIntake::refuse(const fs::path& file, const std::string& reason, Clock::time_point now) {
  Waiting& entry = waiting_.at(file);
  if (now - entry.since >= config_.patience) return give_up(file, reason);
  entry.refused = reason;
}

void FolderIntake::take_in_all(const std::vector<Ready>& files, Clock::time_point now) {
  for (const Ready& file : files) {
    try {
      take_in(file, now);
    } catch (const Overloaded& error) {
      not_before_ = now + error.retry_after();
      return;
    } catch (const StorageError& error) {  // the disk is full, or fails
      complain(error.what());
      not_before_ = now + kIntakeRest;
      return;
    }
  }
}

/// @throws Overloaded, StorageError when nothing can be taken in now.
void FolderIntake::take_in(const Ready& ready, Clock::time_point now) {
  const FileState before = waiting_.at(ready.file).state;
  std::string sha256;
  try {
    sha256 = sha256_of_file(ready.file);
  } catch (const StorageError& error) {
    return give_up(ready.file, error.what());
  }
  try {
    if (!ready.hints.sensor) {
      throw InvalidInput("neither the configuration of the folder nor the side-car names the sensor");
    }
    const UploadResult result = ingest_({ready.file, sha256, ready.hints});
    // One that was written to meanwhile is looked at again as another.
    if (state_of(ready.file) != before) return;
    put_away(ready.file, free_place(done_, ready.file));
    ++(result.already_stored ? status_.known : status_.stored);
    spdlog::info("{}: {} {}", ready.file.string(), result.already_stored ? "already stored as" : "stored as",
                 ids_of(result.scans));
  } catch (const InvalidInput& error) {
    refuse(ready.file, error.what(), now);
  } catch (const UnsupportedFormat& error) {
    refuse(ready.file, error.what(), now);
  } catch (const NotFound& error) {
    refuse(ready.file, error.what(), now);
  } catch (const Conflict& error) {
    give_up(ready.file, error.what());
  } catch (const TooLarge& error) {
    give_up(ready.file, error.what());
  }
}

/// Puts a file away that cannot be taken in. The reason is there first, so that none is without.
void FolderIntake::give_up(const fs::path& file, const std::string& reason) {
  const fs::path target = free_place(failed_, file);
  write_text(target.string() + ".reason.txt", reason);
  put_away(file, target);
  ++status_.failed;
  spdlog::warn("{} was moved to {}: {}", file.string(), target.string(), reason);
}

/// The file first: one without its side-car could not be taken in after a crash between the two.
void FolderIntake::put_away(const fs::path& file, const fs::path& target) {
  move_file(file, target);
  if (state_of(side_car_of(file)) && !state_of(side_car_of(target))) move_file(side_car_of(file), side_car_of(target));
  waiting_.erase(file);
}

/// Side-cars that a crash left behind when their files were put away: they must not be taken for those of later files
/// of the same names.
void FolderIntake::adopt_side_cars() const {
  std::error_code failed;
  std::vector<fs::path> orphans;
  for (fs::directory_iterator entry(config_.path, failed), end; !failed && entry != end; entry.increment(failed)) {
    const fs::path file = fs::path(entry->path()).replace_extension();
    const bool is_side_car = entry->path().extension() == ".json" && has_scan_ending(file);
    if (is_side_car && state_of(entry->path()) && !state_of(file)) orphans.push_back(file);
  }
  for (const fs::path& file : orphans) {
    for (const fs::path& place : {done_, failed_}) {
      const fs::path put_away = place / file.filename();
      if (!state_of(put_away) || state_of(side_car_of(put_away))) continue;
      move_file(side_car_of(file), side_car_of(put_away));
      break;
    }
  }
}

FolderIntake::Clock::time_point FolderIntake::next_look(Clock::time_point now) const {
  Clock::time_point next = now + config_.poll;
  for (const auto& [file, entry] : waiting_) {
    const Clock::time_point due = entry.since + (entry.refused.empty() ? config_.settle : config_.patience);
    if (due > now) next = std::min(next, due);
  }
  return next;
}

}  // namespace raywatch
