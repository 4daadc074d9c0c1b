#pragma once

#include "core/ids.hpp"

namespace raywatch {

using ScheduleId = Id<struct ScheduleTag>;
using RunId = Id<struct RunTag>;
using EpochId = Id<struct EpochTag>;
using SurveyId = Id<struct SurveyTag>;

}  // namespace raywatch
