// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "report/report_page.h"

#include <map>

#include "core/error.h"
#include "report/base64.h"
#include "report/page_files.h"

namespace slambench {
namespace {

constexpr std::string_view page_start = "<!DOCTYPE html>\n<!-- slambench report";

/// Text between tags or in an attribute.
std::string escape_html(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&#39;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

/// JSON inside a script element: with nothing in it that could end the element or open another.
std::string script_json(const nlohmann::ordered_json& data) {
  using Json = nlohmann::ordered_json;
  const std::string text = data.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string escaped;
  escaped.reserve(text.size());
  for (const char c : text) {
    switch (c) {
      case '<':
        escaped += "\\u003c";
        break;
      case '>':
        escaped += "\\u003e";
        break;
      case '&':
        escaped += "\\u0026";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

/// `{{name}}` in the text becomes the value of that name; values are not looked into.
std::string fill(std::string_view text, const std::map<std::string_view, std::string>& values) {
  std::string filled;
  for (;;) {
    const std::size_t open = text.find("{{"), close = text.find("}}", open);
    filled += text.substr(0, open);
    if (open == std::string_view::npos || close == std::string_view::npos) return filled;
    filled += values.at(text.substr(open + 2, close - open - 2));
    text.remove_prefix(close + 2);
  }
}

}  // namespace

bool can_draw_charts() { return !page_files::chart_library().empty(); }

bool is_report_page(std::string_view html) { return html.starts_with(page_start); }

std::string report_page(const std::vector<ReportRun>& runs, const ReportOptions& options) {
  if (!can_draw_charts()) {
    throw UnavailableError(
        "unavailable: this program was built without plotly.js, which draws the charts; install "
        "the Debian package python3-plotly (or: pip install plotly), configure and build again");
  }
  return fill(page_files::page_template(),
              {{"title", escape_html(options.title)},
               {"style", std::string(page_files::style())},
               {"data", script_json(report_data(runs, options))},
               {"chart_library", base64(page_files::chart_library())},
               {"script", std::string(page_files::script_figures()) +
                              std::string(page_files::script_charts()) +
                              std::string(page_files::script_page())}});
}

}  // namespace slambench
