#pragma once

#include <string>

namespace raywatch {

// What a channel may be told of where to send to. Each gives back what it was given. @throws InvalidInput.

/// http or https, a host, no user or password in it, no blanks.
std::string checked_webhook_url(const std::string& url);
/// "whsec_" and the base64 of 24 to 64 bytes. The message does not repeat it.
std::string checked_webhook_secret(const std::string& secret);
/// A name or an address.
std::string checked_host(const std::string& host);
/// A plain address such as guard@example.com, in ASCII.
std::string checked_mail_address(const std::string& address);
/// Levels of an MQTT topic without wildcards.
std::string checked_topic_prefix(const std::string& prefix);
/// A user or password: at most 256 bytes without control characters.
std::string checked_credential(const std::string& text);
/// A type of events, or the beginning of some and '*'.
std::string checked_event_pattern(const std::string& pattern);

}  // namespace raywatch
