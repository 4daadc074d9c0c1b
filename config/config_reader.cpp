#include "config/config_reader.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>
#include <set>
#include <sstream>
#include <utility>

#include "core/nearest_name.hpp"

namespace raywatch {
namespace {

constexpr std::string_view kLine = "line ";

std::string at_line(const toml::source_region& source) {
  return std::string(kLine) + std::to_string(source.begin.line) + ": ";
}

std::string type_name(const toml::node& node) {
  std::ostringstream name;
  name << node.type();
  return name.str();
}

template <class T>
std::string as_text(T number) {
  std::ostringstream text;
  text << number;
  return text.str();
}

template <class T>
std::string range_text(const Allowed<T>& allowed) {
  if (allowed.max == std::numeric_limits<T>::max()) return "at least " + as_text(allowed.min);
  return as_text(allowed.min) + " to " + as_text(allowed.max);
}

std::string parent_of(const std::string& key) {
  const std::size_t dot = key.rfind('.');
  return dot == std::string::npos ? std::string() : key.substr(0, dot);
}

std::string read_all(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string content((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  if (!in.good() && !in.eof()) throw InvalidInput(file.string() + ": cannot be read");
  return content;
}

}  // namespace

struct ConfigReader::Impl {
  std::string name;
  toml::table root;
  std::vector<std::string> known;   ///< bound keys, in order
  std::vector<std::string> arrays;  ///< known arrays of tables
  std::vector<std::string> changed;
  std::vector<FieldError> errors;

  template <class T>
  void assign(std::string_view key, const T& read, T& value) {
    if (read != value) changed.emplace_back(key);
    value = read;
  }

  /// Registers the key and finds its value.
  const toml::node* bind(std::string_view key) {
    known.emplace_back(key);
    return root.at_path(key).node();
  }

  void fail(std::string_view key, const toml::node& node, const std::string& message) {
    errors.push_back({std::string(key), at_line(node.source()) + message});
  }

  void wrong_type(std::string_view key, const toml::node& node, const char* wanted) {
    fail(key, node, std::string("must be ") + wanted + ", not " + type_name(node));
  }

  template <class T>
  void read_plain(std::string_view key, T& value, const char* wanted) {
    const toml::node* node = bind(key);
    if (node == nullptr) return;
    const std::optional<T> read = node->value_exact<T>();
    if (read) {
      assign(key, *read, value);
    } else {
      wrong_type(key, *node, wanted);
    }
  }

  template <class T>
  void assign_allowed(std::string_view key, const toml::node& node, T read, T& value, const Allowed<T>& allowed) {
    if (read >= allowed.min && read <= allowed.max) {
      assign(key, read, value);
    } else {
      fail(key, node, "must be " + range_text(allowed) + ", not " + as_text(read));
    }
  }

  void refuse_unknown(const toml::table& table, const std::string& prefix);
  bool refuse_unknown_in_array(const toml::node& node, const std::string& path);
};

ConfigReader::ConfigReader(std::string_view toml, std::string name) : impl_(std::make_unique<Impl>()) {
  impl_->name = std::move(name);
  try {
    impl_->root = toml::parse(toml, impl_->name);
  } catch (const toml::parse_error& error) {
    const std::string message = at_line(error.source()) + std::string(error.description());
    throw InvalidInput(impl_->name + ": " + message, {{"", message}});
  }
}

ConfigReader::ConfigReader(ConfigReader&&) noexcept = default;
ConfigReader::~ConfigReader() = default;

ConfigReader ConfigReader::open(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) throw InvalidInput(file.string() + ": there is no such file");
  if (std::filesystem::is_directory(file)) throw InvalidInput(file.string() + ": is a directory, not a file");
  if (!std::filesystem::is_regular_file(file)) throw InvalidInput(file.string() + ": is not a regular file");
  return ConfigReader(read_all(file), file.string());
}

void ConfigReader::flag(std::string_view key, bool& value) { impl_->read_plain(key, value, "true or false"); }

void ConfigReader::text(std::string_view key, std::string& value) { impl_->read_plain(key, value, "a string"); }

void ConfigReader::path(std::string_view key, std::filesystem::path& value) {
  std::string read = value.string();
  text(key, read);
  value = read;
}

void ConfigReader::one_of(std::string_view key, std::string& value, std::span<const std::string_view> choices) {
  std::string read = value;
  text(key, read);
  for (const std::string_view choice : choices) {
    if (read != choice) continue;
    value = read;
    return;
  }
  std::string list;
  for (const std::string_view choice : choices) list += (list.empty() ? "" : ", ") + std::string(choice);
  impl_->fail(key, *impl_->root.at_path(key).node(), "must be one of " + list + ", not \"" + read + "\"");
}

void ConfigReader::real(std::string_view key, double& value, Allowed<double> allowed) {
  const toml::node* node = impl_->bind(key);
  if (node == nullptr) return;
  if (!node->is_number()) return impl_->wrong_type(key, *node, "a number");
  impl_->assign_allowed(key, *node, node->value<double>().value_or(std::nan("")), value, allowed);
}

void ConfigReader::read_whole(std::string_view key, std::int64_t& value, Allowed<std::int64_t> allowed) {
  const toml::node* node = impl_->bind(key);
  if (node == nullptr) return;
  const std::optional<std::int64_t> read = node->value_exact<std::int64_t>();
  if (!read) return impl_->wrong_type(key, *node, "a whole number");
  impl_->assign_allowed(key, *node, *read, value, allowed);
}

void ConfigReader::mebibytes(std::string_view key, std::uint64_t& bytes, Allowed<std::uint64_t> allowed) {
  constexpr std::uint64_t kMebibyte = std::uint64_t{1} << 20;
  std::uint64_t count = bytes / kMebibyte;
  whole(key, count, Allowed<std::uint64_t>{allowed.min, std::min(allowed.max, (std::uint64_t{1} << 43) - 1)});
  bytes = count * kMebibyte;
}

std::vector<std::string> ConfigReader::tables(std::string_view key) {
  impl_->arrays.emplace_back(key);
  std::vector<std::string> names;
  const toml::node* node = impl_->root.at_path(key).node();
  if (node == nullptr) return names;
  if (!node->is_array_of_tables()) {
    impl_->wrong_type(key, *node, ("an array of tables, [[" + std::string(key) + "]]").c_str());
    return names;
  }
  for (std::size_t i = 0; i < node->as_array()->size(); ++i) {
    names.push_back(std::string(key) + "[" + std::to_string(i) + "]");
  }
  return names;
}

void ConfigReader::require(std::string_view key) {
  if (impl_->root.at_path(key)) return;
  impl_->fail(key, *impl_->root.at_path(parent_of(std::string(key))).node(), "is missing");
}

void ConfigReader::refuse(std::string_view key, const std::string& message) {
  const toml::node* node = impl_->root.at_path(key).node();
  node != nullptr ? impl_->fail(key, *node, message) : impl_->errors.push_back({std::string(key), message});
}

/// @returns whether the path is that of a known array.
bool ConfigReader::Impl::refuse_unknown_in_array(const toml::node& node, const std::string& path) {
  if (std::ranges::find(arrays, path) == arrays.end()) return false;
  if (!node.is_array_of_tables()) return true;  // which was said when it was bound
  std::size_t i = 0;
  for (const toml::node& element : *node.as_array()) {
    refuse_unknown(*element.as_table(), path + "[" + std::to_string(i++) + "]");
  }
  return true;
}

void ConfigReader::Impl::refuse_unknown(const toml::table& table, const std::string& prefix) {
  std::set<std::string> tables;
  for (const std::string& key : known) tables.insert(parent_of(key));
  for (const std::string& key : arrays) tables.insert(parent_of(key));
  for (const auto& [key, node] : table) {
    const std::string path = prefix.empty() ? std::string(key.str()) : prefix + "." + std::string(key.str());
    if (refuse_unknown_in_array(node, path)) continue;
    if (tables.contains(path)) {
      node.is_table() ? refuse_unknown(*node.as_table(), path) : wrong_type(path, node, "a table");
      continue;
    }
    if (std::find(known.begin(), known.end(), path) != known.end()) continue;
    std::vector<std::string> candidates = known;
    if (node.is_table()) candidates.assign(tables.begin(), tables.end());
    const std::optional<std::string> meant = nearest_name(path, candidates);
    errors.push_back({path, at_line(key.source()) + (node.is_table() ? "unknown table" : "unknown key") +
                                (meant ? "; did you mean " + *meant + "?" : "")});
  }
}

void ConfigReader::finish() {
  impl_->refuse_unknown(impl_->root, "");
  if (impl_->errors.empty()) return;
  std::string message = impl_->name + ":";
  for (const FieldError& error : impl_->errors) {
    message += "\n  " + error.field + (error.message.starts_with(kLine) ? ", " : ": ") + error.message;
  }
  throw InvalidInput(message, impl_->errors);
}

std::vector<std::string> ConfigReader::absent_keys() const {
  std::vector<std::string> absent;
  for (const std::string& key : impl_->known) {
    if (!impl_->root.at_path(key)) absent.push_back(key);
  }
  return absent;
}

const std::vector<std::string>& ConfigReader::changed_keys() const { return impl_->changed; }

}  // namespace raywatch
