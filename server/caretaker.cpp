#include "server/caretaker.hpp"

#include <spdlog/spdlog.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "server/machine.hpp"
#include "server/system_alerts.hpp"
#include "storage/alerts.hpp"
#include "storage/all_of_list.hpp"
#include "storage/scans.hpp"
#include "storage/sensors.hpp"
#include "storage/sites.hpp"

namespace raywatch {
namespace {

/// A sensor is silent when nothing came for so many of its intervals: a scan may be under way.
constexpr double kSilentIntervals = 2.0;

/// A sensor with an interval, and when its last scan came; without one, when it was made.
struct HeardSensor {
  Sensor sensor;
  Time last_heard_at;
  bool stands = false;  ///< its silence is told already

  bool is_silent(Time now) const {
    const std::chrono::duration<double> silence = now - last_heard_at;
    return silence.count() > kSilentIntervals * *sensor.interval_s;
  }
};

SystemSubject silence_of(const Sensor& sensor) {
  return {.site = sensor.site, .cause = "sensor-silent", .subject = sensor.name, .zone = {}, .sensor = sensor.id};
}

std::vector<HeardSensor> heard_sensors(const Snapshot& snapshot) {
  std::vector<HeardSensor> heard;
  for (const Sensor& sensor :
       all_of_list([&](const PageRequest& page) { return list_sensors(snapshot, std::nullopt, page); })) {
    if (!sensor.interval_s) continue;
    const Page<ScanRecord> last = list_scans(snapshot, {.sensor = sensor.id}, {.limit = 1, .cursor = {}});
    const SystemSubject subject = silence_of(sensor);
    heard.push_back({sensor, last.items.empty() ? sensor.created_at : last.items.front().received_at,
                     standing_alert(snapshot, subject.site, subject.cause, subject.subject).has_value()});
  }
  return heard;
}

}  // namespace

void Caretaker::look_after(Time now) {
  wake_snoozed(now);
  look_after_sensors(now);
  look_after_disk(now);
}

void Caretaker::wake_snoozed(Time now) {
  if (store_.read([&](const Snapshot& snapshot) { return snoozed_until(snapshot, now); }).empty()) return;
  store_.write([&](Transaction& transaction) {
    for (const AlertId alert : snoozed_until(transaction, now)) {
      change_alert(transaction, alert,
                   {.action = "woken",
                    .by = std::string(kProgram),
                    .note = "The snooze is over.",
                    .at = now,
                    .state = AlertState::open});
    }
  });
}

void Caretaker::look_after_sensors(Time now) {
  for (const HeardSensor& heard : store_.read(heard_sensors)) {
    if (heard.is_silent(now) == heard.stands) continue;
    store_.write([&](Transaction& transaction) {
      const SystemSubject subject = silence_of(heard.sensor);
      if (heard.stands) return settle_system_alert(transaction, subject, "A scan came.", std::nullopt, now);
      raise_system_alert(transaction, subject,
                         {.severity = Severity::warning,
                          .at = now,
                          .title = "Sensor " + heard.sensor.name + " is silent: its last scan came at " +
                                   format_rfc3339(heard.last_heard_at) + "."});
    });
  }
}

/// Every site is told, for each has its own guards.
void Caretaker::look_after_disk(Time now) {
  const bool is_low = free_disk_bytes(store_.data_dir()) < config_.low_disk_bytes;
  const auto subject_of = [](const Site& site) {
    return SystemSubject{.site = site.id, .cause = "disk-low", .subject = "disk", .zone = {}, .sensor = {}};
  };
  const auto sites = store_.read([&](const Snapshot& snapshot) {
    auto all = all_of_list([&](const PageRequest& page) { return list_sites(snapshot, page); });
    std::erase_if(all, [&](const Site& site) {
      const SystemSubject subject = subject_of(site);
      return standing_alert(snapshot, subject.site, subject.cause, subject.subject).has_value() == is_low;
    });
    return all;
  });
  if (sites.empty()) return;
  store_.write([&](Transaction& transaction) {
    for (const Site& site : sites) {
      if (is_low) {
        raise_system_alert(transaction, subject_of(site),
                           {.severity = Severity::critical,
                            .at = now,
                            .title = "The disk is nearly full: soon no more scans can be stored."});
      } else {
        settle_system_alert(transaction, subject_of(site), "There is room again.", std::nullopt, now);
      }
    }
  });
}

CaretakerThread::CaretakerThread(Caretaker& caretaker, RetentionKeeper& retention, std::function<Time()> now)
    : thread_([&caretaker, &retention, now = std::move(now)](const std::stop_token& stop) {
        std::mutex mutex;
        std::condition_variable_any stopped;
        std::unique_lock lock(mutex);
        // What lasts is said once.
        const auto do_logged = [](std::string& trouble, const auto& what) {
          try {
            what();
            trouble.clear();
          } catch (const Error& error) {
            if (trouble != error.what()) {
              spdlog::error("what happens without a scan cannot be looked after: {}", error.what());
            }
            trouble = error.what();
          }
        };
        std::string trouble_of_looking, trouble_of_keeping;
        while (!stop.stop_requested()) {
          do_logged(trouble_of_looking, [&] { caretaker.look_after(now()); });
          do_logged(trouble_of_keeping, [&] { retention.keep(now()); });
          stopped.wait_for(lock, stop, std::chrono::seconds(1), [] { return false; });
        }
      }) {}

}  // namespace raywatch
