#include "api/field_errors.hpp"

namespace raywatch {

void FieldErrors::add(std::string_view field, std::string_view message) {
  errors_.push_back({std::string(field), std::string(message)});
}

void FieldErrors::throw_if_any() const {
  if (errors_.empty()) return;
  std::string summary;
  for (const FieldError& error : errors_) {
    if (!summary.empty()) summary += "; ";
    summary += error.field.empty() ? error.message : error.field + ": " + error.message;
  }
  throw InvalidInput(summary, errors_);
}

}  // namespace raywatch
