// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "results/output_parameters.h"

namespace slambench {

ParameterList OutputParameters::describe() {
  return with_role(ParameterRole::bookkeeping,
                   {
                       "output",
                       {
                           {"out", 0, "", &out, 0, 0,
                            "folder for the results; a new one under results/ unless given"},
                           {"force", 0, "", &force, 0, 0,
                            "replace the results of an earlier run in that folder"},
                           {"images", 0, "frames", &images, 0, 1000000,
                            "save the pictures of every so many frames, that of the volume where "
                            "it was drawn (rendering-rate); 0: none"},
                           {"log-file", 'o', "", &log_file, 0, 0,
                            "write the per-frame log of SLAMBench 1 to this file too"},
                           {"dump-volume", 'd', "", &dump_volume, 0, 0,
                            "write the volume after the last frame: 16-bit distances, x fastest, "
                            "then y, then z"},
                           {"quiet", 0, "", &quiet, 0, 0, "print errors only"},
                           {"json", 0, "", &json, 0, 0, "print the record instead of the summary"},
                           {"no-gui", 'q', "", &no_gui, 0, 0,
                            "accepted and without effect: no window is opened"},
                       },
                   });
}

}  // namespace slambench
