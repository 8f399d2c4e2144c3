// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "datasets/source.h"

namespace slambench {

/// "living-room/0" to "living-room/3"; "living-room" is path 2. Anything else after the slash
/// matches too, and does not open.
bool is_living_room(const std::string& sequence);

/// The built-in sequence, rendered when it is first needed (scene/living_room.h) and kept in the
/// user's cache folder. Throws InputError for a path that does not exist, UnavailableError when
/// this build cannot render.
std::unique_ptr<Source> open_living_room(const std::string& sequence, const SourceParameters&);

/// Why this build cannot open one, and what would help; empty when it can.
std::string_view living_room_unavailable();

/// Settings that suit a way through the room that starts level and along one of its axes: a volume
/// that holds the whole room.
std::vector<std::pair<std::string, std::string>> living_room_settings(const Pose& T_world_start);

}  // namespace slambench
