// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/study_report.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include "experiments/study/markup_text.h"
#include "experiments/study/report_document.h"
#include "experiments/study/study_figures.h"
#include "experiments/study/study_summary.h"
#include "experiments/study/svg_plot.h"

namespace frond {
namespace {

constexpr std::size_t kProblemsShown = 12,
                      kProblemsFolded = 60;  // with convergence figures; folded up to the latter

constexpr std::string_view kCss = R"(
:root{color-scheme:light dark;--text:#1d1f21;--soft:#5c6166;--line:#d9dcdf;--fill:#f4f6f7;--mark:#005a9c;--back:#fff}
*{box-sizing:border-box}
body{margin:0 auto;max-width:84rem;padding:0 1.25rem 4rem;background:var(--back);color:var(--text);
font:16px/1.5 system-ui,-apple-system,"Segoe UI",sans-serif}
main{min-width:0}
h1{font-size:1.8rem;line-height:1.2;margin:1.5rem 0 .5rem;overflow-wrap:anywhere}
h2{font-size:1.3rem;margin:2.5rem 0 .75rem;padding-top:.5rem;border-top:1px solid var(--line)}
p,ul{max-width:46rem;overflow-wrap:anywhere}
ul{padding-left:1.2rem}
li{margin:.25rem 0}
a{color:var(--mark)}
nav{font-size:.9rem}
nav ol{list-style:none;margin:0;padding:.5rem 0;display:flex;flex-wrap:wrap;gap:.2rem 1rem}
nav a{text-decoration:none}
nav a:hover{text-decoration:underline}
.answer{background:var(--fill);border-left:4px solid var(--mark);padding:.25rem 1.25rem .75rem;margin-top:1rem}
.answer h2{border:0;margin:.5rem 0 0;padding:0}
.answer>p{font-size:1.15rem}
.scroll{overflow-x:auto;margin:.5rem 0 1.5rem}
table{border-collapse:collapse;font-size:.9rem;font-variant-numeric:tabular-nums}
.caption{color:var(--soft);font-size:.9rem;margin:1rem 0 0}
th,td{padding:.3rem .55rem;border-bottom:1px solid var(--line);text-align:left;vertical-align:top}
td.n,th.n{text-align:right}
td{white-space:nowrap}
td:not(.n){white-space:normal;overflow-wrap:break-word}
thead th{vertical-align:bottom;border-bottom:2px solid var(--line);font-weight:600}
tbody th{font-weight:500;position:sticky;left:0;background:var(--back);overflow-wrap:break-word}
tbody strong{color:var(--mark)}
.figures{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,24rem),1fr));gap:1rem 2rem}
figure{margin:1rem 0;min-width:0}
figure svg{display:block;max-width:100%;height:auto}
figcaption{font-size:.85rem;color:var(--soft);max-width:34rem;overflow-wrap:anywhere}
details>summary{cursor:pointer;color:var(--mark);margin:.4rem 0}
figure details{font-size:.85rem}
@media (min-width:72rem){
body{display:grid;grid-template-columns:11rem minmax(0,1fr);gap:2.5rem}
nav{position:sticky;top:1rem;align-self:start;padding-top:1.5rem}
nav ol{display:block}
nav li{margin:.4rem 0}
}
@media (max-width:71.99rem){
nav{position:sticky;top:0;z-index:1;background:var(--back);border-bottom:1px solid var(--line)}
h2,section{scroll-margin-top:5rem}}
@media (max-width:40rem){body{padding:0 .8rem 3rem}nav{position:static}th,td{padding:.25rem .45rem}
tbody th{min-width:7rem;max-width:9rem;overflow-wrap:anywhere}}
@media print{nav,figure details{display:none}body{display:block;max-width:none;font-size:10pt}
figure,table{break-inside:avoid}.scroll{overflow:visible}tbody th{position:static}
.figures{grid-template-columns:1fr 1fr}}
)";

std::string DarkCss() {
  return "@media screen and (prefers-color-scheme:dark){:root{--text:#e6e6e6;--soft:#a6abb0;--line:#3a3f44;"
         "--fill:#1f2428;--mark:#6cb6ff;--back:#15181b}" +
         PlotDarkCss() + "}\n";
}

struct HtmlSection {
  std::string id, title, html;
};

std::string FigureHtml(const ReportFigure& figure) {
  return "<figure>\n" + figure.svg + "<figcaption>" + EscapeXml(figure.caption) +
         "</figcaption>\n<details><summary>Data</summary>\n" + TableHtml(figure.data) +
         "</details>\n</figure>\n";
}

std::string FiguresHtml(const std::vector<ReportFigure>& figures) {
  std::string html = "<div class=\"figures\">\n";
  for (const ReportFigure& figure : figures) html += FigureHtml(figure);
  return html + "</div>\n";
}

HtmlSection ConvergenceSection(const StudyAnalysis& analysis) {
  const std::size_t all = analysis.problems.size();
  const std::size_t shown = std::min(all, kProblemsShown), drawn = std::min(all, kProblemsFolded);
  std::string html;
  const auto add = [&](std::size_t begin, std::size_t end) {
    std::vector<ReportFigure> figures;
    for (std::size_t p = begin; p < end; ++p) {
      for (ReportFigure& figure : ConvergenceFigures(analysis, p)) figures.push_back(std::move(figure));
    }
    html += FiguresHtml(figures);
  };
  if (all > shown) {
    html += "<p>The first " + std::to_string(shown) + " of " + std::to_string(all) + " problems; " +
            (drawn < all ? "those up to the " + std::to_string(drawn) + "th" : std::string("the others")) +
            " are folded below" + (drawn < all ? ", the rest are in the traces only" : "") + ".</p>\n";
  }
  add(0, shown);
  if (drawn > shown) {
    html += "<details><summary>Problems " + std::to_string(shown + 1) + " to " + std::to_string(drawn) +
            "</summary>\n";
    add(shown, drawn);
    html += "</details>\n";
  }
  return {"convergence", "Convergence", html};
}

std::vector<HtmlSection> HtmlSections(const StudyPlan& plan, const StudyAnalysis& analysis) {
  std::vector<HtmlSection> sections;
  for (const ReportSection& section : StudySections(plan, analysis)) {
    if (section.id == "problems" && !analysis.problems.empty())
      sections.push_back(ConvergenceSection(analysis));
    sections.push_back({section.id, section.title, SectionHtml(section)});
    if (section.id == "solvers") {
      sections.push_back({"profiles", "Profiles", FiguresHtml(ProfileFigures(plan, analysis))});
    } else if (section.id == "ranks") {
      for (const ReportFigure& figure : RankFigures(analysis)) sections.back().html += FigureHtml(figure);
    }
  }
  return sections;
}

}  // namespace

std::string StudyReportHtml(const StudyPlan& plan, const StudyAnalysis& analysis) {
  const std::vector<HtmlSection> sections = HtmlSections(plan, analysis);
  const std::string name = EscapeXml(plan.name);
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n<title>" +
      name + "</title>\n<style>" + std::string(kCss) + DarkCss() +
      "</style>\n</head>\n<body>\n<nav aria-label=\"Contents\">\n<ol>\n";
  for (const HtmlSection& section : sections) {
    html += "<li><a href=\"#" + section.id + "\">" + EscapeXml(section.title) + "</a></li>\n";
  }
  html += "</ol>\n</nav>\n<main>\n<h1>" + name + "</h1>\n";
  for (const HtmlSection& section : sections) {
    html += "<section id=\"" + section.id + "\"" + (section.id == "answer" ? " class=\"answer\"" : "") +
            ">\n<h2>" + EscapeXml(section.title) + "</h2>\n" + section.html + "</section>\n";
  }
  return html + "</main>\n</body>\n</html>\n";
}

}  // namespace frond
