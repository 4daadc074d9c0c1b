#include "server/system_alerts.hpp"

#include "core/error.hpp"
#include "storage/alerts.hpp"
#include "storage/sensors.hpp"

namespace raywatch {

void raise_system_alert(Transaction& transaction, const SystemSubject& subject, const SystemNews& news) {
  if (standing_alert(transaction, subject.site, subject.cause, subject.subject)) return;
  open_alert(transaction,
             {.site = subject.site,
              .cause = subject.cause,
              .subject = subject.subject,
              .title = news.title,
              .severity = news.severity,
              .zone = subject.zone,
              .sensor = subject.sensor,
              .scan = news.scan,
              .opened_at = news.at},
             "");
}

void settle_system_alert(Transaction& transaction, const SystemSubject& subject, const std::string& why,
                         std::optional<ScanId> scan, Time now) {
  const std::optional<AlertRecord> alert = standing_alert(transaction, subject.site, subject.cause, subject.subject);
  if (!alert) return;
  change_alert(transaction, alert->id,
               {.action = "resolved",
                .by = std::string(kProgram),
                .note = why,
                .at = now,
                .state = AlertState::resolved,
                .resolved_as_gone = true,
                .scan = scan});
}

std::string sensor_name(const Snapshot& snapshot, SensorId sensor) {
  const std::optional<Sensor> found = find_sensor(snapshot, sensor);
  if (!found) throw NotFound("the sensor of the scan does not exist any more");
  return found->name;
}

}  // namespace raywatch
