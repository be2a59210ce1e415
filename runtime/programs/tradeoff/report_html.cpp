// runtime/programs/tradeoff/report_html.cpp: one page that needs nothing else: tables to sort,
// plots, small pictures.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runtime/programs/tradeoff/plot.h"
#include "runtime/programs/tradeoff/tradeoff.h"
#include "runtime/scene/images/png_memory.h"

namespace kinora {

namespace {

constexpr std::string_view kTradeHead = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>kinora-render: trade-off</title>
<meta name="viewport" content="width=device-width, initial-scale=1">
<style>
:root { color-scheme: light dark; --line: #8885; --soft: #8882; --best: #1b7f3b; }
body { font: 15px/1.45 system-ui, sans-serif; margin: 0 auto; max-width: 1200px; padding: 1rem; }
h1 { font-size: 1.3rem; } h2 { font-size: 1.1rem; margin-top: 2rem; }
table { border-collapse: collapse; font-size: .82rem; font-variant-numeric: tabular-nums; }
div.wide { overflow-x: auto; } td, th { padding: .15rem .5rem; text-align: right; white-space: nowrap; }
td:first-child, th:first-child { text-align: left; }
th { cursor: pointer; border-bottom: 2px solid var(--line); } tr { border-bottom: 1px solid var(--soft); }
th[aria-sort=ascending]::after { content: " \25B2"; } th[aria-sort=descending]::after { content: " \25BC"; }
tr.best td:first-child { color: var(--best); font-weight: 600; } td.floor { opacity: .55; }
tr.out { opacity: .55; } td.why { text-align: left; }
svg.plot { width: 100%; max-width: 760px; height: auto; font: 12px system-ui, sans-serif; }
svg.plot text { fill: currentColor; } svg.plot .tick { opacity: .7; font-size: 11px; }
.grid { stroke: var(--line); stroke-width: .5; } .floor { stroke: currentColor; stroke-dasharray: 4 3; }
td.floor { stroke: none; } .front { fill: none; stroke: var(--best); stroke-width: 1.5; }
.point { opacity: .75; } .best { stroke: var(--best); stroke-width: 2; opacity: 1; }
figure { margin: 1rem 0; } figcaption { font-weight: 600; }
.pictures { display: grid; grid-template-columns: repeat(auto-fill, minmax(200px, 1fr)); gap: .8rem; }
.pictures figcaption { font-weight: 400; font-size: .8rem; } .pictures figure { margin: 0; }
.pictures img { width: 100%; display: block; image-rendering: pixelated; background: #555; }
</style></head><body>
)";

constexpr std::string_view kTradeScript = R"(<script>
'use strict';
function sortBy(th) {
  const table = th.closest('table'), body = table.tBodies[0];
  const column = [...th.parentNode.cells].indexOf(th);
  const up = th.getAttribute('aria-sort') !== 'ascending';
  for (const other of th.parentNode.cells) other.removeAttribute('aria-sort');
  th.setAttribute('aria-sort', up ? 'ascending' : 'descending');
  const key = row => { const cell = row.cells[column]; return cell ? cell.dataset.v ?? cell.textContent : ''; };
  const compare = (a, b) => {
    const x = key(a), y = key(b), p = parseFloat(x), q = parseFloat(y);
    if (isNaN(p) !== isNaN(q)) return isNaN(p) ? 1 : -1;
    return (up ? 1 : -1) * (isNaN(p) ? x.localeCompare(y) : p - q);
  };
  body.append(...[...body.rows].sort(compare));
}
for (const th of document.querySelectorAll('th')) th.addEventListener('click', () => sortBy(th));
</script>
)";

std::string shown_name(const TradeRow& row) {
    return html_text(row.variant.name);
}

std::string summary_html(const TradeResults& r) {
    std::string text = fmt::format("<h1>Speed against accuracy: {}</h1>\n<p>{}&times;{} pixels",
                                   html_text(r.scene), r.plan.width, r.plan.height);
    if (r.plan.width != r.asked_width)
        text += fmt::format(" (asked {}&times;{})", r.asked_width, r.asked_height);
    text += fmt::format(
        ", frame {}. The reference is the mean of two renders of {} samples with other seeds, "
        "{:.0f} "
        "s. Their difference is the noise floor: FLIP {:.4f}, RMSE {:.5f}. An error that is no "
        "larger reads <q>&le; floor</q>. Target {}, {} threads. {:.0f} s of {:g} s were "
        "used.</p>\n",
        frames_text(r), r.plan.reference_samples, r.reference_s, r.floor.picture.flip,
        r.floor.picture.rmse, r.target, r.threads, r.used_s, r.budget_s);
    if (r.plan.final_samples > 0)
        text += fmt::format(
            "<p>To keep within the budget, final's knobs were measured with {} sample{} a pixel, "
            "beside a base with as many{}.</p>\n",
            r.plan.final_samples, r.plan.final_samples == 1 ? "" : "s",
            r.plan.preview_samples > 0 ? ", and preview's likewise" : "");
    return text +
           "<p>Times are CPU times of a frame: the median of its ratios to the base's renders "
           "before "
           "and after it, times the base's median. The interval holds the true median with the "
           "probability shown. Click a heading to sort.</p>\n";
}

std::string number_cell(double value, const char* format = "{:.4g}") {
    if (std::isnan(value)) return "<td></td>";
    return fmt::format("<td data-v=\"{:.9g}\">{}</td>", value,
                       fmt::vformat(format, fmt::make_format_args(value)));
}
std::string optional_cell(const std::optional<double>& value) {
    return value ? number_cell(*value) : "<td></td>";
}

std::string row_cells(const TradeRow& row, const TradeResults& r) {
    const TradeTimes& t = row.times;
    std::string text =
        fmt::format("<tr{}><td>{}</td>", row.on_front ? " class=best" : "", shown_name(row));
    text += number_cell(t.ms.median) +
            fmt::format("<td>{:.4g}&ndash;{:.4g} ({:.0f} %)</td>", t.ms.low, t.ms.high,
                        100 * t.ms.cover) +
            number_cell(t.ratio, "{:.3f}") + number_cell(t.wall_ms) + number_cell(t.build_ms);
    for (const TradeMetric& metric : trade_metrics()) {
        double value = metric.get(row.errors);
        if (within_floor(metric, row.errors, r.floor))
            text += fmt::format("<td class=floor data-v=\"{:.9g}\">&le; floor</td>", value);
        else
            text += number_cell(value);
    }
    const TradeErrors& e = row.errors;
    text += optional_cell(e.vertex_units) + optional_cell(e.vertex_pixels) +
            number_cell(e.hit_distance) + number_cell(e.hit_mismatch) + optional_cell(e.ulp_max) +
            optional_cell(e.ulp_p99);
    return text + number_cell(100 * row.off_front, "{:.0f} %") +
           fmt::format("<td>{}</td></tr>\n", row.same_picture ? "yes" : "");
}

std::string table_html(const TradeResults& r, VariantKind kind, const char* title) {
    std::string text = fmt::format(
        "<h2>{}</h2>\n<div class=wide><table><thead><tr><th>settings<th>CPU ms<th>interval<th>of "
        "the base<th>wall ms<th>build ms",
        title);
    for (const TradeMetric& metric : trade_metrics())
        text += fmt::format("<th>{}", html_text(metric.title));
    text +=
        "<th>vertex, units<th>vertex, pixels<th>hit distance<th>hit mismatch<th>ULP, "
        "largest<th>ULP, "
        "99 %<th>off the front<th>same bits as its base</tr></thead><tbody>\n";
    for (const TradeRow& row : r.rows) {
        if (row.variant.kind != kind) continue;
        text += row.measured()
                    ? row_cells(row, r)
                    : fmt::format(
                          "<tr class=out><td>{}</td><td colspan=21 class=why>not measured: "
                          "{}</td></tr>\n",
                          shown_name(row), html_text(row.not_measured));
    }
    return text + "</tbody></table></div>\n";
}

std::string front_plot(const TradeResults& r) {
    Plot plot{.title = "All variants: FLIP against the CPU time of a frame",
              .x_title = "CPU ms a frame",
              .y_title = "FLIP",
              .points = {},
              .floor = r.floor.picture.flip};
    for (const TradeRow& row : r.rows)
        if (row.measured())
            plot.points.push_back({row.times.ms.median, row.errors.picture.flip, row.variant.name,
                                   variant_kind_name(row.variant.kind),
                                   row.variant.kind == VariantKind::Preset, row.on_front});
    return plot_svg(plot);
}

// The settings of the knobs of a stage, against the time that the stage takes; presets beside them.
std::string stage_plot(const TradeResults& r, Stage stage) {
    Plot plot{.title = fmt::format("Stage {}", stage_name(stage)),
              .x_title = fmt::format("CPU ms of {} a frame", stage_name(stage)),
              .y_title = "FLIP",
              .points = {},
              .floor = r.floor.picture.flip};
    bool any = false;
    for (const TradeRow& row : r.rows) {
        const Knob* knob = row.variant.knob;
        bool preset = row.variant.kind == VariantKind::Preset;
        if (!row.measured() || !(preset || (knob && knob->stage == stage_name(stage)))) continue;
        any = any || knob;
        plot.points.push_back({row.times.stages[size_t(stage)], row.errors.picture.flip,
                               row.variant.name, knob ? std::string(knob->option) : "presets",
                               preset, false});
    }
    return any ? plot_svg(plot) : "";
}

std::string image_html(const std::vector<uint8_t>& png) {
    return png.empty()
               ? ""
               : fmt::format("<img alt=\"\" src=\"data:image/png;base64,{}\">", base64(png));
}

std::string pictures_html(const TradeResults& r) {
    std::string text = fmt::format(
        "<h2>Pictures of frame {}, and their FLIP</h2>\n<p>FLIP from black (0) over violet and "
        "orange to white (1), by its root.</p>\n<div class=pictures>\n",
        r.frames.empty() ? 0 : r.frames[0].number);
    for (const TradeRow& row : r.rows)
        if (row.measured() && !row.picture_png.empty())
            text +=
                fmt::format("<figure>{}{}<figcaption>{}, FLIP {}</figcaption></figure>\n",
                            image_html(row.picture_png), image_html(row.flip_png), shown_name(row),
                            html_text(error_text(*find_trade_metric("flip"), row, r.floor)));
    return text + "</div>\n";
}

std::string off_front_html(const TradeResults& r) {
    std::string text;
    for (const TradeRow& row : r.rows)
        if (row.variant.kind == VariantKind::Preset && row.measured() &&
            row.off_front > kMostOffFront)
            text += fmt::format("<li>{}: another variant is no worse and {:.0f} % faster",
                                shown_name(row), 100 * (1 - 1 / (1 + row.off_front)));
    return text.empty() ? "" : "<h2>Presets off the front</h2>\n<ul>" + text + "</ul>\n";
}

}  // namespace

std::string tradeoff_html(const TradeResults& r) {
    std::string page(kTradeHead);
    page += summary_html(r) + off_front_html(r) + front_plot(r);
    page += table_html(r, VariantKind::Preset, "Presets");
    page += table_html(r, VariantKind::Knob, "Each knob alone");
    page += table_html(r, VariantKind::Combination, "Combinations");
    page += "<h2>Stages</h2>\n";
    for (size_t s = 0; s < kStageCount; ++s) page += stage_plot(r, Stage(s));
    page += pictures_html(r);
    page += kTradeScript;
    return page + "</body></html>\n";
}

}  // namespace kinora
