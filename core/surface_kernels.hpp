#pragma once

#include "core/ask_kernels.hpp"

namespace raywatch {

/// How the prior's returns within T_a of a point's direction lie to the point, and to the plane through them.
struct Surface {
  bool is_plane = false;        ///< they surround the point, and a plane can be fitted
  float before_m = 0.0f;        ///< how far the point lies before the plane; towards the sensor: positive
  float cosine = 0.0f;          ///< of the incidence of the point's ray on the plane
  float farthest_off_m = 0.0f;  ///< of the returns, from the plane
  float nearest_m = 0.0f;       ///< the distance from the point to the nearest of them; infinite when there is none
};

/// The surface that a prior shows around each point. In directions u_i and ranges rho_i a plane is the linear function
/// n . u_i = 1 / rho_i; seen from the tangent plane at the point's direction u, where both sides are divided by u .
/// u_i, it is a linear regression in two variables, at any incidence. In single precision: good to some 1e-6 of the
/// range. Thread-safe.
void find_surfaces(const PreparedPrior& prior, const PointPlanes& points, const RigidMotion& prior_from_points,
                   Surface* surfaces);

}  // namespace raywatch
