#include "core/sensor.hpp"
