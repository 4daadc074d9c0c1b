#pragma once

// Internal: only .cpp files of api/ include this.
#include "api/call.hpp"
#include "api/httplib.hpp"

namespace raywatch {

class Dashboard;
class Listener;

/// What stays the same for all requests.
struct ExchangeContext {
  const Services& services;
  const HttpConfig& config;
  const Dashboard& dashboard;
  HttpStatistics& statistics;
  StreamSlots& streams;
  Listener& listener;
};

/// Answers one request: finds its route, lets the endpoint work, and turns whatever it throws into a problem.
/// @param reader of the content; null for methods without.
void answer_request(const ExchangeContext& context, const httplib::Request& request, httplib::Response& response,
                    const httplib::ContentReader* reader);

/// Refuses content that is announced to be larger than anything that is taken.
void refuse_too_large(const HttpConfig& config, const httplib::Request& request, httplib::Response& response);

/// The content's framing. @throws HttpError (400) for a length that is none or is given twice.
RequestBody::Framing framing_of(const httplib::Request& request);

}  // namespace raywatch
