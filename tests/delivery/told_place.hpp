#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "server/delivery/deliverer.hpp"
#include "storage/alerts.hpp"
#include "storage/deliveries.hpp"
#include "storage/sites.hpp"
#include "tests/support/temp_dir.hpp"

namespace raywatch::test {

/// A store with the site "Höfe" in Berlin, and the deliverer that tells of it. It retries after milliseconds.
class ToldPlace {
 public:
  explicit ToldPlace(DeliveryConfig config = quick());
  ~ToldPlace();
  static DeliveryConfig quick();

  ChannelId add(const std::string& name, const ChannelSettings& settings, ChannelRecord channel = {});
  AlertId open_alert(const std::string& title, Severity severity = Severity::warning);
  void acknowledge(AlertId alert);

  ChannelRecord channel(ChannelId id) const;
  std::vector<DeliveryRecord> deliveries(ChannelId channel) const;  ///< oldest first
  /// The system alerts about channels, oldest first.
  std::vector<AlertRecord> failing_alerts() const;
  /// Waits until something holds. @throws std::runtime_error when it does not come to that.
  void wait_until(const std::function<bool()>& holds);
  /// Waits until nothing waits for a channel any more. @returns its deliveries, oldest first.
  std::vector<DeliveryRecord> wait_until_ended(ChannelId channel, std::size_t count);

  Store& store() { return store_; }
  SiteId site() const { return site_.id; }
  Deliverer& deliverer() { return *deliverer_; }
  static Time now() { return std::chrono::system_clock::now(); }

 private:
  TempDir folder_;
  Store store_;
  Site site_;
  std::unique_ptr<Deliverer> deliverer_;
};

inline const std::string kSecret = "whsec_MfKQ9r8GKYqrTwjUPD8ILPZIo2LaLaSw";

}  // namespace raywatch::test
