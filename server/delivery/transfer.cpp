#include "server/delivery/transfer.hpp"

#include <curl/curl.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>

#include "api/text_values.hpp"
#include "core/error.hpp"

namespace raywatch {
namespace {

/// So much of an answer is kept for the log, and so much is read at all.
constexpr std::size_t kKept_bytes = 500, kRead_bytes = 64 * 1024;
constexpr int kPoll_ms = 1000;

struct FreeEasy {
  void operator()(CURL* handle) const { curl_easy_cleanup(handle); }
};
struct FreeMulti {
  void operator()(CURLM* handle) const { curl_multi_cleanup(handle); }
};
struct FreeList {
  void operator()(curl_slist* list) const { curl_slist_free_all(list); }
};
struct FreeUrl {
  void operator()(CURLU* url) const { curl_url_cleanup(url); }
};
using List = std::unique_ptr<curl_slist, FreeList>;

List list_of(const std::vector<std::string>& texts) {
  List list;
  for (const std::string& text : texts) {
    curl_slist* longer = curl_slist_append(list.get(), text.c_str());
    if (longer == nullptr) throw Error("there is no memory for a message");
    static_cast<void>(list.release());
    list.reset(longer);
  }
  return list;
}

}  // namespace

struct Transfer::Impl {
  template <class Value>
  void set(CURLoption option, Value value) {
    if (const CURLcode code = curl_easy_setopt(easy.get(), option, value); code != CURLE_OK) {
      throw Error(std::string("libcurl refuses a setting: ") + curl_easy_strerror(code));
    }
  }

  static std::size_t take_answer(const char* bytes, std::size_t, std::size_t size, void* self) {
    Impl& impl = *static_cast<Impl*>(self);
    impl.received += size;
    impl.content.append(bytes, std::min(size, kKept_bytes - std::min(kKept_bytes, impl.content.size())));
    return impl.received <= kRead_bytes ? size : 0;
  }
  static std::size_t give_upload(char* bytes, std::size_t size, std::size_t count, void* self) {
    Impl& impl = *static_cast<Impl*>(self);
    const std::size_t given = std::min(size * count, impl.upload.size() - impl.uploaded);
    std::memcpy(bytes, impl.upload.data() + impl.uploaded, given);
    impl.uploaded += given;
    return given;
  }

  CURLcode perform(const std::stop_token& stop);

  std::unique_ptr<CURL, FreeEasy> easy{curl_easy_init()};
  List headers, recipients;
  std::string upload;
  std::size_t uploaded = 0, received = 0;
  std::string content;
  std::array<char, CURL_ERROR_SIZE> error{};
};

Transfer::Transfer(const std::string& url, const std::string& schemes, const SenderConfig& config)
    : impl_(std::make_unique<Impl>()) {
  if (!impl_->easy) throw Error("libcurl cannot be used");
  impl_->set(CURLOPT_URL, url.c_str());
  impl_->set(CURLOPT_PROTOCOLS_STR, schemes.c_str());
  impl_->set(CURLOPT_FOLLOWLOCATION, 0L);
  impl_->set(CURLOPT_NOSIGNAL, 1L);
  impl_->set(CURLOPT_QUICK_EXIT, 1L);  // does not wait for a name that nobody answers for
  impl_->set(CURLOPT_CONNECTTIMEOUT_MS, static_cast<long>(config.connect_timeout.count()));
  impl_->set(CURLOPT_TIMEOUT_MS, static_cast<long>(config.timeout.count()));
  impl_->set(CURLOPT_PROXY, config.proxy.c_str());
  impl_->set(CURLOPT_ERRORBUFFER, impl_->error.data());
  impl_->set(CURLOPT_WRITEFUNCTION, &Impl::take_answer);
  impl_->set(CURLOPT_WRITEDATA, static_cast<void*>(impl_.get()));
  if (!config.ca_file.empty()) impl_->set(CURLOPT_CAINFO, config.ca_file.c_str());
}

Transfer::~Transfer() = default;

void Transfer::post(const std::string& body, const std::vector<std::string>& headers) {
  impl_->headers = list_of(headers);
  impl_->set(CURLOPT_HTTPHEADER, impl_->headers.get());
  impl_->set(CURLOPT_POSTFIELDSIZE_LARGE, static_cast<curl_off_t>(body.size()));
  impl_->set(CURLOPT_COPYPOSTFIELDS, body.c_str());
}

void Transfer::mail(const std::string& from, const std::vector<std::string>& to, const std::string& message) {
  impl_->recipients = list_of(to);
  impl_->upload = message;
  impl_->set(CURLOPT_MAIL_FROM, from.c_str());
  impl_->set(CURLOPT_MAIL_RCPT, impl_->recipients.get());
  impl_->set(CURLOPT_UPLOAD, 1L);
  impl_->set(CURLOPT_READFUNCTION, &Impl::give_upload);
  impl_->set(CURLOPT_READDATA, static_cast<void*>(impl_.get()));
}

void Transfer::log_in(const std::string& user, const std::string& password) {
  impl_->set(CURLOPT_USERNAME, user.c_str());
  impl_->set(CURLOPT_PASSWORD, password.c_str());
}

void Transfer::require_starttls() { impl_->set(CURLOPT_USE_SSL, static_cast<long>(CURLUSESSL_ALL)); }
void Transfer::only_connect() { impl_->set(CURLOPT_CONNECT_ONLY, 1L); }

CURLcode Transfer::Impl::perform(const std::stop_token& stop) {
  const std::unique_ptr<CURLM, FreeMulti> multi(curl_multi_init());
  if (!multi || curl_multi_add_handle(multi.get(), easy.get()) != CURLM_OK) return CURLE_OUT_OF_MEMORY;
  CURLcode result = CURLE_ABORTED_BY_CALLBACK;
  {
    const std::stop_callback wake(stop, [&] { curl_multi_wakeup(multi.get()); });
    int running = 1;
    while (running > 0 && !stop.stop_requested()) {
      if (curl_multi_perform(multi.get(), &running) != CURLM_OK) break;
      if (running > 0) curl_multi_poll(multi.get(), nullptr, 0, kPoll_ms, nullptr);
    }
  }
  int left = 0;
  while (const CURLMsg* told = curl_multi_info_read(multi.get(), &left)) {
    if (told->msg == CURLMSG_DONE) result = told->data.result;
  }
  curl_multi_remove_handle(multi.get(), easy.get());
  return result;
}

TransferEnd Transfer::run(const std::stop_token& stop) {
  const CURLcode code = impl_->perform(stop);
  TransferEnd end;
  curl_easy_getinfo(impl_->easy.get(), CURLINFO_RESPONSE_CODE, &end.response_code);
  curl_off_t retry_after_s = 0;
  curl_easy_getinfo(impl_->easy.get(), CURLINFO_RETRY_AFTER, &retry_after_s);
  if (retry_after_s > 0) end.retry_after = std::chrono::seconds(retry_after_s);
  end.content = std::move(impl_->content);
  // An answer that is too long was an answer.
  end.complete = code == CURLE_OK || (code == CURLE_WRITE_ERROR && impl_->received > kRead_bytes);
  end.interrupted = code == CURLE_ABORTED_BY_CALLBACK;
  if (!end.complete) end.error = impl_->error[0] != '\0' ? impl_->error.data() : curl_easy_strerror(code);
  return end;
}

// Read as libcurl does when it uses one.
bool is_proxy(const std::string& text) {
  const std::unique_ptr<CURLU, FreeUrl> url(curl_url());
  constexpr unsigned kFlags = CURLU_NON_SUPPORT_SCHEME | CURLU_GUESS_SCHEME;
  if (!url || curl_url_set(url.get(), CURLUPART_URL, text.c_str(), kFlags) != CURLUE_OK) return false;
  constexpr std::array<std::string_view, 7> kSchemes = {"http",    "https",  "socks",  "socks4",
                                                        "socks4a", "socks5", "socks5h"};
  const std::size_t scheme = text.find("://");
  return scheme == std::string::npos || std::ranges::find(kSchemes, lower(text.substr(0, scheme))) != kSchemes.end();
}

TransferLibrary::TransferLibrary() {
  if (curl_global_init(CURL_GLOBAL_DEFAULT) != CURLE_OK) throw Error("libcurl cannot be used");
}
TransferLibrary::~TransferLibrary() { curl_global_cleanup(); }

}  // namespace raywatch
