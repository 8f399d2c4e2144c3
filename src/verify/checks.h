// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

namespace slambench {

class Trial;

/// One per line of the table of checks: adds the check's cases to the trial.
void check_mm2meters(Trial& trial);
void check_bilateral_filter(Trial& trial);
void check_half_sample(Trial& trial);
void check_depth2vertex(Trial& trial);
void check_vertex2normal(Trial& trial);
void check_track(Trial& trial);
void check_reduce(Trial& trial);
void check_solve(Trial& trial);
void check_align(Trial& trial);
void check_integrate(Trial& trial);
void check_raycast(Trial& trial);
void check_render_depth(Trial& trial);
void check_render_track(Trial& trial);
void check_render_volume(Trial& trial);
void check_init_volume(Trial& trial);
void check_generate_gaussian(Trial& trial);
void check_memory(Trial& trial);
void check_pipeline(Trial& trial);

}  // namespace slambench
