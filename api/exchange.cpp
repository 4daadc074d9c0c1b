#include "api/exchange.hpp"

#include <sstream>
#include <streambuf>

#include "api/dashboard.hpp"
#include "api/guard.hpp"
#include "api/listener.hpp"
#include "api/problem.hpp"
#include "api/routes.hpp"
#include "api/text_values.hpp"

namespace raywatch {
namespace {

std::optional<std::string> header_of(const httplib::Request& request, const std::string& name) {
  if (!request.has_header(name)) return std::nullopt;
  return request.get_header_value(name);
}

RequestBody body_of(const httplib::Request& request, const httplib::ContentReader* reader) {
  RequestBody::Framing framing = framing_of(request);
  if (reader == nullptr) framing.present = false;
  const auto source = [reader](const RequestBody::Take& take) {
    return (*reader)([&](const char* bytes, std::size_t size) { return take({bytes, size}); });
  };
  return {source, framing};
}

HttpAnswer options_answer(std::string_view path) {
  HttpAnswer answer;
  answer.status = 204;
  answer.set_header("Allow", allowed_methods(path));
  return answer;
}

/// Whatever is no address of the API is the dashboard's.
std::optional<HttpAnswer> dashboard_answer(const Dashboard& dashboard, const httplib::Request& request,
                                           std::string_view path) {
  if ((request.method != "GET" && request.method != "HEAD") || belongs_to_api(path)) return std::nullopt;
  return dashboard.answer({.path = path,
                           .accept = header_of(request, "Accept"),
                           .accept_encoding = header_of(request, Listener::kAcceptEncoding),
                           .if_none_match = header_of(request, "If-None-Match")});
}

HttpAnswer answer_of(const ExchangeContext& context, const httplib::Request& request, RequestBody& body) {
  const std::string_view target = request.target;
  const std::size_t question = target.find('?');
  const std::string_view path = target.substr(0, question);
  const std::string_view query = question == std::string_view::npos ? "" : target.substr(question + 1);
  check_source({request.method, request.version, header_of(request, "Host"), header_of(request, "Origin")},
               {is_loopback_host(context.config.host), context.config.public_url});
  if (request.method == "OPTIONS") return options_answer(path);
  if (auto page = dashboard_answer(context.dashboard, request, path)) return *std::move(page);
  RouteMatch match = find_route(request.method, path);
  Listener& listener = context.listener;
  Call call{
      .services = context.services,
      .config = context.config,
      .statistics = context.statistics,
      .streams = context.streams,
      .path = std::move(match.values),
      .query = Query(query.substr(0, query.find('#'))),
      .body = body,
      .header = [&request](const std::string& name) { return header_of(request, name); },
      .abandoned = [&listener] { return listener.is_stopping() || listener.current_connection().peer_is_gone(); }};
  return match.route->handle(call);
}

/// Gathers what is written and sends it in large pieces.
class SinkBuffer final : public std::streambuf {
 public:
  explicit SinkBuffer(httplib::DataSink& sink) : sink_(sink) { setp(buffer_.data(), buffer_.data() + buffer_.size()); }

 protected:
  int_type overflow(int_type character) override {
    if (!send()) return traits_type::eof();
    if (character != traits_type::eof()) sputc(traits_type::to_char_type(character));
    return traits_type::not_eof(character);
  }
  int sync() override { return send() ? 0 : -1; }

 private:
  bool send() {
    const auto size = static_cast<std::size_t>(pptr() - pbase());
    setp(buffer_.data(), buffer_.data() + buffer_.size());
    return size == 0 || sink_.write(buffer_.data(), size);
  }

  httplib::DataSink& sink_;
  std::vector<char> buffer_ = std::vector<char>(256 << 10);
};

/// Nothing may be thrown here: the library calls this outside of its own handlers. A client that gets a part only sees
/// that the last chunk is missing.
bool send_stream(const std::function<void(std::ostream&)>& write, httplib::DataSink& sink) {
  try {
    SinkBuffer buffer(sink);
    std::ostream out(&buffer);
    write(out);
    if (!out.flush()) return false;
    sink.done();
    return true;
  } catch (...) {
    return false;
  }
}

void fill_content(const httplib::Request& request, HttpAnswer& answer, httplib::Response& response) {
  const bool chunked = answer.stream && request.method != "HEAD" && request.version != "HTTP/1.0";
  if (chunked) {
    response.set_chunked_content_provider(
        answer.content_type,
        [write = std::move(answer.stream)](std::size_t, httplib::DataSink& sink) { return send_stream(write, sink); });
  } else if (answer.endless) {
    response.set_content("", answer.content_type);  // HTTP/1.0 has no chunks, and HEAD no content
  } else if (answer.stream) {
    std::ostringstream out;
    answer.stream(out);
    response.set_content(std::move(out).str(), answer.content_type);
  } else if (!answer.content_type.empty()) {
    response.set_content(answer.body, answer.content_type);
  }
}

void fill_response(const httplib::Request& request, HttpAnswer answer, httplib::Response& response) {
  response.status = answer.status;
  for (const auto& [name, value] : answer.headers) response.set_header(name, value);
  if (!response.has_header("Cache-Control")) {
    response.set_header("Cache-Control", response.has_header("ETag") ? "no-cache" : "no-store");
  }
  response.set_header("X-Content-Type-Options", "nosniff");
  response.set_header("Accept-Ranges", "none");
  fill_content(request, answer, response);
}

/// The library decodes what it knows under these names, and takes all else as it comes.
std::string encoding_of(const httplib::Request& request) {
  if (!request.has_header("Content-Encoding")) return {};
  std::string encoding = request.get_header_value("Content-Encoding");
  if (lower(encoding) == "identity") return {};
  const bool is_known = encoding == "gzip" || encoding == "deflate" || encoding == "br";
  if (!is_known || request.get_header_value_count("Content-Encoding") > 1) throw HttpError(problem_of_status(415));
  return encoding;
}

}  // namespace

RequestBody::Framing framing_of(const httplib::Request& request) {
  RequestBody::Framing framing;
  framing.content_type = request.get_header_value("Content-Type");
  framing.encoding = encoding_of(request);
  const bool chunked = lower(request.get_header_value("Transfer-Encoding")) == "chunked";
  if (request.has_header("Transfer-Encoding") && !chunked) {
    throw HttpError(bad_request("The only Transfer-Encoding that is read is chunked."));
  }
  if (request.get_header_value_count("Content-Length") + (chunked ? 1 : 0) > 1) {
    throw HttpError(bad_request("The length of the content is given more than once."));
  }
  if (request.has_header("Content-Length")) {
    const auto length = parse_integer(request.get_header_value("Content-Length"));
    if (!length || *length < 0) throw HttpError(bad_request("Content-Length is not a length."));
    framing.length = static_cast<std::uint64_t>(*length);
  }
  framing.present = chunked || framing.length.value_or(0) > 0;
  return framing;
}

void refuse_too_large(const HttpConfig& config, const httplib::Request& request, httplib::Response& response) {
  const auto length = parse_integer(request.get_header_value("Content-Length"));
  if (!length || *length <= 0 || static_cast<std::uint64_t>(*length) <= config.max_body_bytes) return;
  HttpAnswer answer = to_answer(problem_of(std::make_exception_ptr(too_large(config.max_body_bytes))));
  answer.set_header("Connection", "close");
  fill_response(request, std::move(answer), response);
}

void answer_request(const ExchangeContext& context, const httplib::Request& request, httplib::Response& response,
                    const httplib::ContentReader* reader) {
  HttpAnswer answer;
  bool read_to_the_end = false;
  try {
    RequestBody body = body_of(request, reader);
    try {
      answer = answer_of(context, request, body);
    } catch (...) {
      answer = to_answer(problem_of(std::current_exception()));
    }
    read_to_the_end = body.finished();
  } catch (...) {
    answer = to_answer(problem_of(std::current_exception()));
  }
  if (read_to_the_end) {
    context.listener.keep_current_connection();
  } else {
    answer.set_header("Connection", "close");
  }
  context.statistics.count(answer.status);
  if (answer.status == 500 && context.services.report) {
    context.services.report(request.method + " " + request.target + " failed: " + answer.body);
  }
  fill_response(request, std::move(answer), response);
}

}  // namespace raywatch
