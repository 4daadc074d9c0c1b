#pragma once

#include "api/text_values.hpp"

namespace CLI {
class Validator;
}

namespace raywatch {

/// @{ Checks the number that an option is given, by the rules of the API and in its words: no "nan", and no negative
/// number where none fits.
CLI::Validator within(const RealBounds& bounds);
CLI::Validator within(const IntegerBounds& bounds);
/// @}

}  // namespace raywatch
