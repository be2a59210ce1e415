// runtime/programs/validate/report_html.cpp: one page that needs nothing else: findings with their
// source lines, to be filtered by severity, code and file.
#include <fmt/format.h>

#include <algorithm>

#include "runtime/base/display_path.h"
#include "runtime/programs/validate/escaped_text.h"
#include "runtime/programs/validate/report.h"

namespace kinora {

namespace {

constexpr size_t kWidestLine = 160;  // of longer ones a part is shown
constexpr int kContextLines = 1;     // before and after

constexpr std::string_view kHead = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>kinora-validate</title>
<meta name="viewport" content="width=device-width, initial-scale=1">
<style>
:root { color-scheme: light dark; --line: #8884; --error: #c62828; --warning: #b26a00;
  --info: #1565c0; --hint: #607d8b; --soft: #8881; }
body { font: 15px/1.45 system-ui, sans-serif; margin: 0 auto; max-width: 1100px; padding: 1rem; }
h1 { font-size: 1.3rem; margin: .2rem 0 .6rem; }
#bar { position: sticky; top: 0; background: Canvas; padding: .5rem 0; display: flex; gap: .8rem;
  flex-wrap: wrap; align-items: center; border-bottom: 1px solid var(--line); z-index: 1; }
#bar input[type=search], #bar select { font: inherit; padding: .15rem .4rem; max-width: 20rem; }
section { margin: 1rem 0; }
h2 { font: 600 1rem ui-monospace, monospace; margin: 1.2rem 0 .4rem; overflow-wrap: anywhere; }
h2 small { font-weight: normal; opacity: .7; }
article { border-left: 4px solid var(--hint); margin: .5rem 0; padding: .2rem .8rem;
  background: var(--soft); }
article.error { border-color: var(--error); } article.warning { border-color: var(--warning); }
article.info { border-color: var(--info); }
article p { margin: .2rem 0; overflow-wrap: anywhere; }
b.error { color: var(--error); } b.warning { color: var(--warning); } b.info { color: var(--info); }
code, pre, .path { font-family: ui-monospace, monospace; font-size: .86rem; }
pre { margin: .3rem 0; padding: .4rem; overflow-x: auto; border: 1px solid var(--line); }
pre span { opacity: .5; user-select: none; } mark { background: #f57c0055; color: inherit; }
.path { opacity: .75; } .help::before { content: "help: "; font-weight: 600; }
details p { opacity: .8; } .none { opacity: .6; }
</style></head><body>
<h1>kinora-validate</h1>
<div id="bar"><span id="severities"></span>
<select id="code"><option value="">every code</option></select>
<input id="file" type="search" placeholder="file name or text"> <span id="shown"></span></div>
<main>
)";

// The page counts and filters what is in it.
constexpr std::string_view kScript = R"(<script>
'use strict';
const items = [...document.querySelectorAll('article')];
const sections = [...document.querySelectorAll('section')];
const boxes = {};
for (const severity of ['error', 'warning', 'info', 'hint']) {
  const count = items.filter(a => a.dataset.severity === severity).length;
  const label = document.createElement('label'), box = document.createElement('input');
  box.type = 'checkbox'; box.checked = true; boxes[severity] = box;
  box.addEventListener('change', update);
  label.append(box, ' ' + count + ' ' + severity + ' ');
  document.getElementById('severities').append(label);
}
const code = document.getElementById('code'), text = document.getElementById('file');
const counts = new Map();
for (const a of items) counts.set(a.dataset.code, (counts.get(a.dataset.code) || 0) + 1);
for (const [name, count] of [...counts].sort()) code.add(new Option(name + ' (' + count + ')', name));
code.addEventListener('change', update); text.addEventListener('input', update);
function update() {
  const words = text.value.toLowerCase();
  let shown = 0;
  for (const s of sections) {
    const named = s.dataset.file.toLowerCase().includes(words);
    let any = false;
    for (const a of s.querySelectorAll('article')) {
      const on = boxes[a.dataset.severity].checked && (!code.value || a.dataset.code === code.value)
        && (named || a.textContent.toLowerCase().includes(words));
      a.hidden = !on; any = any || on; shown += on;
    }
    s.hidden = !any && !(named && !code.value && !s.querySelector('article'));
  }
  document.getElementById('shown').textContent = shown + ' of ' + items.length + ' shown';
}
update();
</script>
)";

// A line with the bytes [begin, end) of it marked.
std::string marked_line(std::string_view line, size_t begin, size_t end) {
    begin = std::min(begin, line.size());
    end = std::clamp(end, begin, line.size());
    size_t first =
        begin > kWidestLine / 2 && line.size() > kWidestLine ? begin - kWidestLine / 2 : 0;
    size_t last = std::min(line.size(), first + kWidestLine);
    end = std::min(end, last);
    std::string text = first ? "&hellip;" : "";
    text += xml_text(line.substr(first, begin - first));
    if (end > begin)
        text += fmt::format("<mark>{}</mark>", xml_text(line.substr(begin, end - begin)));
    text += xml_text(line.substr(end, last - end));
    return text + (last < line.size() ? "&hellip;" : "");
}

std::string excerpt(Location where, const SourceFiles& files) {
    if (where.file == kNoFile || files.text(where.file).empty()) return {};
    LineColumn at = files.line_column(where.file, where.begin);
    size_t begin = size_t(at.column) - 1;
    size_t length = where.end > where.begin ? where.end - where.begin : 1;
    std::string text = "<pre>";
    for (int line = std::max(1, at.line - kContextLines); line <= at.line + kContextLines; ++line) {
        std::string_view source = files.line_text(where.file, line);
        if (line > at.line && source.empty()) continue;
        bool own = line == at.line;
        text += fmt::format("<span>{:>6}  </span>{}\n", line,
                            marked_line(source, own ? begin : 0, own ? begin + length : 0));
    }
    return text + "</pre>";
}

std::string location_html(Location where, const SourceFiles& files) {
    if (where.file == kNoFile) return {};
    LineColumn at = files.line_column(where.file, where.begin);
    return fmt::format("{}:{}:{}", xml_text(display_path(files.name(where.file))), at.line,
                       at.column);
}

std::string article(const Finding& finding, const SourceFiles& files) {
    const char* severity = severity_name(finding.severity);
    std::string text = fmt::format(
        "<article class=\"{}\" data-severity=\"{}\" data-code=\"{}\">\n<p><b class=\"{}\">{}</b> "
        "{} <code>[{}]</code></p>\n<p class=\"path\">{} {}</p>\n{}",
        severity, severity, finding.info->code, severity, severity, xml_text(finding.message),
        finding.info->code, location_html(finding.where, files), xml_text(finding.id_path),
        excerpt(finding.where, files));
    for (const Note& note : finding.notes)
        text +=
            fmt::format("<p>note: {} <span class=\"path\">{}</span></p>{}", xml_text(note.message),
                        location_html(note.where, files), excerpt(note.where, files));
    if (!finding.help.empty())
        text += fmt::format("<p class=\"help\">{}</p>", xml_text(finding.help));
    if (*finding.info->explanation)
        text += fmt::format("<details><summary>why</summary><p>{}</p></details>",
                            xml_text(finding.info->explanation));
    return text + "</article>\n";
}

std::string html_head(const ValidateSettings&) {
    return std::string(kHead);
}

std::string html_file(const FileResult& result, const ValidateSettings&) {
    std::string text = fmt::format("<section data-file=\"{0}\"><h2>{0} <small>{1}</small></h2>\n",
                                   xml_text(result.name), counts_text(result.counts));
    for (const Finding& finding : result.findings) text += article(finding, result.files());
    if (result.findings.empty()) text += "<p class=\"none\">no findings</p>\n";
    if (result.hidden)
        text += fmt::format("<p class=\"none\">{} more not shown</p>\n", result.hidden);
    if (result.info)
        text += fmt::format("<details><summary>what it holds</summary><pre>{}</pre></details>\n",
                            xml_text(info_text(result.name, *result.info)));
    return text + "</section>\n";
}

std::string html_tail(const ValidateTotals& totals, const ValidateSettings&) {
    return fmt::format(
        "</main>\n<p class=\"none\">{}: {}. kinora-validate {}</p>\n{}</body></html>\n",
        counted(totals.files, "file"), counts_text(totals.counts), KINORA_VERSION, kScript);
}

}  // namespace

const ReportFormat kHtmlReport{"html", html_head, html_file, "", html_tail};

}  // namespace kinora
