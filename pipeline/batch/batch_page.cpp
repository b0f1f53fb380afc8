#include "pipeline/batch/batch_page.h"

#include <fmt/format.h>

#include <algorithm>

namespace lozenge {
namespace {

constexpr const char* kHead = R"(<!DOCTYPE html>
<html lang="en">
<meta charset="utf-8">
<title>Lozenge batch</title>
<style>
body { font: 14px sans-serif; margin: 1.5em; color: #222; background: #fff; }
table { border-collapse: collapse; }
th, td { padding: 4px 10px; border-bottom: 1px solid #ddd; text-align: right; vertical-align: middle; }
th { cursor: pointer; position: sticky; top: 0; background: #f4f4f4; white-space: nowrap; }
th[aria-sort=ascending]::after { content: " \25B2"; }
th[aria-sort=descending]::after { content: " \25BC"; }
.text { text-align: left; max-width: 32em; overflow-wrap: anywhere; }
tr.bad { background: #fdecea; }
img { height: 96px; display: block; }
</style>
)";

constexpr const char* kScript = R"(<script>
const table = document.querySelector("table"), heads = [...table.tHead.rows[0].cells];
function sort(column, descending) {
  const value = row => {
    const text = row.cells[column].dataset.value;
    return heads[column].dataset.kind === "number" ? (text === "" ? -Infinity : Number(text)) : text;
  };
  const order = (a, b) => value(a) < value(b) ? -1 : value(a) > value(b) ? 1 : 0;
  const rows = [...table.tBodies[0].rows].sort((a, b) => descending ? order(b, a) : order(a, b));
  table.tBodies[0].append(...rows);
  heads.forEach((head, k) => k === column ? head.ariaSort = descending ? "descending" : "ascending" : head.removeAttribute("aria-sort"));
}
heads.forEach((head, k) => head.onclick = () => sort(k, head.ariaSort === "ascending"));
const asked = /^#sort=(-?)(\w+)$/.exec(location.hash);
const column = asked ? heads.findIndex(head => head.dataset.key === asked[2]) : -1;
if (column >= 0) sort(column, asked[1] === "-");
for (const image of document.images) image.onerror = () => image.replaceWith("no preview");
</script>
)";

std::string escaped(const std::string& text) {
  std::string html;
  for (const char c : text) {
    switch (c) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      default:
        html += c;
    }
  }
  return html;
}

/// A path as a relative address: a colon in its first part would make it a scheme.
std::string address(const std::string& path) {
  std::string url = "./";
  constexpr std::string_view kPlain = "-._~/";
  for (const char c : path) {
    const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                          kPlain.find(c) != std::string_view::npos;
    url += is_plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return url;
}

std::string head_cell(const char* key, const char* title, bool is_number) {
  return fmt::format("<th data-key=\"{}\" data-kind=\"{}\"{}>{}</th>\n", key, is_number ? "number" : "text",
                     is_number ? "" : " class=\"text\"", title);
}

std::string text_cell(const std::string& text) {
  return fmt::format("<td class=\"text\" data-value=\"{0}\">{0}</td>", escaped(text));
}

std::string number_cell(const std::string& value, const std::string& shown) {
  return fmt::format("<td data-value=\"{}\">{}</td>", value, shown);
}

std::string number_cell(double value, const char* format) {
  return number_cell(fmt::format("{}", value), fmt::format(fmt::runtime(format), value));
}

std::string cells_of_result(const BatchRow& row) {
  if (!row.is_done()) return number_cell("", "") + number_cell("", "") + number_cell("", "") + number_cell("", "");
  const std::int64_t finest = row.triangles.empty() ? 0 : row.triangles.front();
  return number_cell(static_cast<double>(row.samples), "{}") + number_cell(row.distortion, "{:.4f}") +
         number_cell(std::to_string(finest), fmt::format("{}", fmt::join(row.triangles, ", "))) +
         (row.deviation ? number_cell(*row.deviation, "{:.4f} %") : number_cell("", ""));
}

std::string row_of_table(const BatchRow& row) {
  const std::string picture = row.is_done()
                                  ? fmt::format("<a href=\"{}\"><img loading=\"lazy\" alt=\"\" src=\"{}\"></a>",
                                                address(row.output + ".glb"), address(row.output + ".preview.png"))
                                  : "";
  return fmt::format("<tr{}><td data-value=\"\">{}</td>", row.is_done() ? "" : " class=\"bad\"", picture) +
         text_cell(row.asset) + text_cell(row.status) + text_cell(row.message) + number_cell(row.seconds, "{:.1f}") +
         number_cell(row.memory_mb, "{:.0f}") + cells_of_result(row) + "</tr>\n";
}

}  // namespace

std::string batch_page(const std::vector<BatchRow>& rows) {
  std::vector<BatchRow> sorted = rows;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const BatchRow& a, const BatchRow& b) { return a.is_done() < b.is_done(); });
  const auto failed = std::count_if(rows.begin(), rows.end(), [](const BatchRow& row) { return !row.is_done(); });
  std::string page = kHead;
  page += fmt::format("<h1>{} assets, {} of them not done</h1>\n<table>\n<thead><tr>\n", rows.size(), failed);
  page += head_cell("preview", "", false) + head_cell("asset", "asset", false) + head_cell("status", "status", false) +
          head_cell("message", "message", false) + head_cell("seconds", "seconds", true) +
          head_cell("memory", "MB", true) + head_cell("samples", "N", true) +
          head_cell("distortion", "distortion", true) + head_cell("triangles", "triangles", true) +
          head_cell("deviation", "deviation", true);
  page += "</tr></thead>\n<tbody>\n";
  for (const BatchRow& row : sorted) page += row_of_table(row);
  return page + "</tbody>\n</table>\n" + kScript + "</html>\n";
}

}  // namespace lozenge
