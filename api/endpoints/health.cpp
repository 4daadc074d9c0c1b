#include <sstream>

#include "api/call.hpp"
#include "api/endpoints/endpoints.hpp"
#include "api/json.hpp"
#include "api/problem.hpp"

namespace raywatch::endpoints {
namespace {

/// What keeps the daemon from its work, in words; empty when nothing does.
std::string trouble(const DaemonStatus& status) {
  if (!status.writable) return "The store cannot be written.";
  if (status.workers_alive < status.workers_expected) {
    return "Only " + std::to_string(status.workers_alive) + " of " + std::to_string(status.workers_expected) +
           " workers are alive.";
  }
  return {};
}

class MetricsText {
 public:
  void add(const char* name, const char* type, const char* help, std::uint64_t value) {
    head(name, type, help);
    out_ << name << ' ' << value << '\n';
  }
  void head(const char* name, const char* type, const char* help) {
    out_ << "# HELP " << name << ' ' << help << "\n# TYPE " << name << ' ' << type << '\n';
  }
  void add_of_kind(const char* name, ChannelKind kind, std::uint64_t value) {
    out_ << name << "{kind=\"" << to_string(kind) << "\"} " << value << '\n';
  }
  void add_answers(int hundreds, std::uint64_t value) {
    out_ << "raywatch_http_answers_total{status=\"" << hundreds << "xx\"} " << value << '\n';
  }
  std::string text() const { return out_.str(); }

 private:
  std::ostringstream out_;
};

void add_daemon(MetricsText& metrics, const DaemonStatus& status) {
  metrics.add("raywatch_store_writable", "gauge", "1 when the store can be written.", status.writable ? 1 : 0);
  metrics.add("raywatch_workers_alive", "gauge", "Threads that run comparisons.", status.workers_alive);
  metrics.add("raywatch_workers_expected", "gauge", "Threads that should.", status.workers_expected);
  metrics.add("raywatch_queue_length", "gauge", "Comparisons that are not finished.", status.queue_length);
  metrics.add("raywatch_queue_limit", "gauge", "Above this many, uploads are refused.", status.queue_limit);
  metrics.add("raywatch_scans_ingested_total", "counter", "Scans stored since the start.", status.scans_ingested);
  metrics.add("raywatch_comparisons_finished_total", "counter", "Comparisons finished since the start.",
              status.comparisons_finished);
  metrics.add("raywatch_comparisons_failed_total", "counter", "Comparisons failed since the start.",
              status.comparisons_failed);
  metrics.add("raywatch_retention_scans_deleted_total", "counter", "Scans that retention deleted since the start.",
              status.scans_deleted);
  metrics.add("raywatch_retention_bytes_deleted_total", "counter", "What these took.", status.bytes_deleted);
  metrics.add("raywatch_retention_events_deleted_total", "counter", "Old events deleted since the start.",
              status.events_deleted);
  metrics.add("raywatch_folder_files_stored_total", "counter", "Files of watched folders stored since the start.",
              status.folder_files_stored);
  metrics.add("raywatch_folder_files_known_total", "counter", "Files that were stored already.",
              status.folder_files_known);
  metrics.add("raywatch_folder_files_failed_total", "counter", "Files that could not be taken in.",
              status.folder_files_failed);
  metrics.add("raywatch_folder_files_waiting", "gauge", "Files that lie in watched folders.",
              status.folder_files_waiting);
  metrics.add("raywatch_index_cache_bytes", "gauge", "Memory of cached prior indexes.", status.index_cache_bytes);
  metrics.add("raywatch_index_cache_limit_bytes", "gauge", "Its limit.", status.index_cache_limit_bytes);
  metrics.add("raywatch_index_cache_hits_total", "counter", "Priors found in the cache.", status.index_cache_hits);
  metrics.add("raywatch_index_cache_misses_total", "counter", "Priors indexed anew.", status.index_cache_misses);
  metrics.add("raywatch_free_disk_bytes", "gauge", "Free space where the store lies.", status.free_disk_bytes);
  metrics.add("raywatch_resident_memory_bytes", "gauge", "Memory of the program.", status.resident_bytes);
}

void add_deliveries(MetricsText& metrics, const std::vector<DeliveryFigures>& figures) {
  struct Figure {
    const char *name, *type, *help;
    std::uint64_t DeliveryFigures::*value;
  };
  constexpr Figure kFigures[] = {
      {"raywatch_deliveries_pending", "gauge", "Messages that wait or are under way.", &DeliveryFigures::pending},
      {"raywatch_deliveries_delivered_total", "counter", "Messages that arrived since the start.",
       &DeliveryFigures::delivered},
      {"raywatch_deliveries_failed_total", "counter", "Messages given up since the start.", &DeliveryFigures::failed}};
  for (const Figure& figure : kFigures) {
    metrics.head(figure.name, figure.type, figure.help);
    for (const DeliveryFigures& of_kind : figures)
      metrics.add_of_kind(figure.name, of_kind.kind, of_kind.*figure.value);
  }
}

}  // namespace

HttpAnswer get_health(Call& call) {
  call.query.finish();
  return json_answer({{"status", "ok"}});
}

HttpAnswer get_readiness(Call& call) {
  call.query.finish();
  const DaemonStatus status = call.services.status();
  const std::string problem = trouble(status);
  if (!problem.empty()) throw HttpError(not_ready(problem));
  return json_answer({{"status", "ready"},
                      {"workers", status.workers_alive},
                      {"queue_length", status.queue_length},
                      {"queue_limit", status.queue_limit}});
}

HttpAnswer get_metrics(Call& call) {
  call.query.finish();
  MetricsText metrics;
  const DaemonStatus status = call.services.status();
  add_daemon(metrics, status);
  add_deliveries(metrics, status.deliveries);
  metrics.head("raywatch_http_answers_total", "counter", "HTTP answers by the first digit of their status.");
  for (int hundreds = 2; hundreds <= 5; ++hundreds) {
    metrics.add_answers(hundreds, call.statistics.answers[static_cast<std::size_t>(hundreds)]);
  }
  HttpAnswer answer;
  answer.content_type = "text/plain; version=0.0.4; charset=utf-8";
  answer.body = metrics.text();
  return answer;
}

}  // namespace raywatch::endpoints
