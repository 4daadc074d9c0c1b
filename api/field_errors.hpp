#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"

namespace raywatch {

/// Gathers everything that is wrong with the parts of one input, so that its author hears all of it at once.
class FieldErrors {
 public:
  void add(std::string_view field, std::string_view message);
  bool empty() const { return errors_.empty(); }
  /// @throws InvalidInput with everything gathered, if there is anything.
  void throw_if_any() const;

 private:
  std::vector<FieldError> errors_;
};

}  // namespace raywatch
