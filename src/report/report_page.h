// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "report/report_data.h"

namespace slambench {

/// Whether this program has the library that draws the charts; docs/report.md says how to get it.
bool can_draw_charts();

/// Whether the text is a page that report_page() wrote, of any version.
bool is_report_page(std::string_view html);

/// The HTML file: complete in itself, asks for nothing else. The data, names and paths in it are
/// text that no browser takes for markup. Throws UnavailableError without the chart library.
std::string report_page(const std::vector<ReportRun>& runs, const ReportOptions& options);

}  // namespace slambench
