#pragma once

#include "core/change.hpp"
#include "storage/columns.hpp"
#include "storage/sqlite.hpp"

namespace raywatch {

// A change as it stands in rows of changes and of tracks, from the column `kind` to the column `unknown`.

inline PoseBytes box_pose_bytes(const Change& change) {
  return pose_bytes({change.box.world_from_box, change.box.center_m});
}

/// Binds the next 20 parameters. `box_pose` (see `box_pose_bytes`) must live until the statement ran.
void bind_change(Statement& row, const Change& change, const PoseBytes& box_pose);
Change take_change(Statement& row);

}  // namespace raywatch
