#pragma once

// Internal: only .cpp files of api/ include this.
//
// cpp-httplib includes <resolv.h>, whose macro `_res` is a parameter's name in Eigen.
#include <httplib.h>
#undef _res
