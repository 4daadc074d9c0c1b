#include "core/pose.hpp"
