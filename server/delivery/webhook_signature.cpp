#include "server/delivery/webhook_signature.hpp"

#include <openssl/evp.h>
#include <openssl/hmac.h>

#include <algorithm>
#include <array>

#include "api/base64.hpp"
#include "core/error.hpp"

namespace raywatch {

namespace {

constexpr std::string_view kSecretPrefix = "whsec_";

std::vector<std::uint8_t> key_of(std::string_view secret) {
  auto key = from_base64(secret.substr(std::min(kSecretPrefix.size(), secret.size())));
  if (!secret.starts_with(kSecretPrefix) || !key) throw InvalidInput("A secret must be whsec_ and base64.");
  return *std::move(key);
}

}  // namespace

std::int64_t unix_seconds(Time time) {
  return std::chrono::floor<std::chrono::seconds>(time).time_since_epoch().count();
}

std::string webhook_signature(const std::vector<std::string>& secrets, std::string_view id, Time sent_at,
                              std::string_view body) {
  std::string content(id);
  content += "." + std::to_string(unix_seconds(sent_at)) + ".";
  content += body;
  std::string signatures;
  for (const std::string& secret : secrets) {
    const std::vector<std::uint8_t> key = key_of(secret);
    std::array<std::uint8_t, EVP_MAX_MD_SIZE> digest{};
    unsigned length = 0;
    if (HMAC(EVP_sha256(), key.data(), static_cast<int>(key.size()),
             reinterpret_cast<const unsigned char*>(content.data()), content.size(), digest.data(),
             &length) == nullptr) {
      throw Error("HMAC-SHA256 is not available from the cryptographic library");
    }
    signatures += (signatures.empty() ? "v1," : " v1,") + base64({digest.data(), length});
  }
  return signatures;
}

}  // namespace raywatch
