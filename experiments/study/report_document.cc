// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/report_document.h"

#include <algorithm>

#include "experiments/study/markup_text.h"

namespace frond {
namespace {

constexpr std::size_t kLongTable = 12;  // rows; longer ones are folded away in HTML

// The lines of a header of at most `width` where its words allow.
std::vector<std::string> HeaderLines(const std::string& name, std::size_t width) {
  std::vector<std::string> lines(1);
  std::size_t begin = 0;
  while (begin <= name.size()) {
    const std::size_t end = std::min(name.find(' ', begin), name.size());
    const std::string word = name.substr(begin, end - begin);
    std::string& line = lines.back();
    if (line.empty()) {
      line = word;
    } else if (TextWidth(line) + 1 + TextWidth(word) <= width) {
      line += " " + word;
    } else {
      lines.push_back(word);
    }
    begin = end + 1;
  }
  return lines;
}

struct TextColumn {
  std::vector<std::string> header, cells;
  bool right = false;
  std::size_t width = 0;
};

TextColumn TextColumnOf(const Table& table, std::size_t column) {
  TextColumn text;
  text.right = table.columns[column].number;
  for (const auto& row : table.rows) {
    text.cells.push_back(row[column].text);
    text.width = std::max(text.width, TextWidth(row[column].text));
  }
  text.header = HeaderLines(table.columns[column].name, text.width);
  for (const std::string& line : text.header) text.width = std::max(text.width, TextWidth(line));
  return text;
}

std::string Padded(const std::string& text, std::size_t width, bool right) {
  const std::string blanks(width - std::min(width, TextWidth(text)), ' ');
  return right ? blanks + text : text + blanks;
}

std::string WithoutTrailingBlanks(const std::string& line) {
  const std::size_t last = line.find_last_not_of(' ');
  return line.substr(0, last == std::string::npos ? 0 : last + 1) + "\n";
}

std::string Emphasised(const TableCell& cell, const std::string& text, const char* before,
                       const char* after) {
  return cell.strong ? before + text + after : text;
}

// What the caption begins with.
std::string Subject(const Table& table) {
  return table.caption.substr(0, table.caption.find_first_of(".:;,("));
}

}  // namespace

std::string TableMarkdown(const Table& table) {
  std::string text = EscapeMarkdown(table.caption) + "\n\n|", rule = "|";
  for (const Table::Column& column : table.columns) {
    text += " " + EscapeMarkdown(column.name) + " |";
    rule += column.number ? "---:|" : "---|";
  }
  text += "\n" + rule + "\n";
  for (const auto& row : table.rows) {
    text += "|";
    for (const TableCell& cell : row) {
      text += " " + Emphasised(cell, EscapeMarkdown(cell.text), "**", "**") + " |";
    }
    text += "\n";
  }
  return text;
}

std::string TableHtml(const Table& table) {
  std::string html = "<table aria-label=\"" + EscapeXml(Subject(table)) + "\">\n<thead><tr>";
  for (const Table::Column& column : table.columns) {
    html += std::string("<th scope=\"col\"") + (column.number ? " class=\"n\"" : "") + ">" +
            EscapeXml(column.name) + "</th>";
  }
  html += "</tr></thead>\n<tbody>\n";
  for (const auto& row : table.rows) {
    html += "<tr>";
    for (std::size_t k = 0; k < row.size(); ++k) {
      std::string cell = EscapeXml(row[k].text);
      if (const std::size_t comma = cell.find(", "); table.columns[k].number && comma != std::string::npos) {
        cell.replace(comma, 2, "<br/>");  // "12.3 (10.1–15), 28/30" in two lines
      }
      const std::string text = Emphasised(row[k], cell, "<strong>", "</strong>");
      const char* const numeric = table.columns[k].number ? " class=\"n\"" : "";
      html += k == 0 ? "<th scope=\"row\">" + text + "</th>"
                     : "<td" + std::string(numeric) + ">" + text + "</td>";
    }
    html += "</tr>\n";
  }
  // The caption is not the table's own: it would scroll with it, out of a narrow screen.
  html = "<p class=\"caption\">" + EscapeXml(table.caption) + "</p>\n<div class=\"scroll\" tabindex=\"0\">" +
         html + "</tbody>\n</table></div>\n";
  if (table.rows.size() <= kLongTable) return html;
  return "<details><summary>" + EscapeXml(Subject(table)) + " (" + std::to_string(table.rows.size()) +
         " rows)</summary>\n" + html + "</details>\n";
}

std::string TableText(const Table& table, const std::vector<std::size_t>& shown, std::size_t width) {
  std::vector<TextColumn> columns;
  std::size_t total = 0, header = 0;
  for (const std::size_t k : shown) {
    columns.push_back(TextColumnOf(table, k));
    total += columns.back().width + 2;
    header = std::max(header, columns.back().header.size());
  }
  if (columns.empty()) return "";
  total -= 2;
  if (total > width) {
    TextColumn& first = columns[0];
    first.width = std::max<std::size_t>(8, first.width - std::min(first.width, total - width));
    for (std::string& cell : first.cells) cell = Shortened(cell, first.width);
  }
  std::string text;
  const auto add_line = [&](const auto& cell_of) {
    std::string line;
    for (std::size_t k = 0; k < columns.size(); ++k) {
      line += (k > 0 ? "  " : "") + Padded(cell_of(columns[k]), columns[k].width, columns[k].right);
    }
    text += WithoutTrailingBlanks(line);
  };
  for (std::size_t i = 0; i < header; ++i) {
    add_line([&](const TextColumn& c) {  // headers stand on the rule
      const std::size_t skipped = header - c.header.size();
      return i < skipped ? std::string() : c.header[i - skipped];
    });
  }
  add_line([](const TextColumn& c) { return std::string(c.width, '-'); });
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    add_line([&](const TextColumn& c) { return c.cells[i]; });
  return text;
}

std::string SectionMarkdown(const ReportSection& section) {
  std::string text = "## " + EscapeMarkdown(section.title) + "\n";
  for (const auto& block : section.blocks) {
    text += "\n";
    if (const auto* paragraph = std::get_if<Paragraph>(&block)) {
      text += EscapeMarkdown(*paragraph) + "\n";
    } else if (const auto* list = std::get_if<BulletList>(&block)) {
      for (const std::string& item : *list) text += "- " + EscapeMarkdown(item) + "\n";
    } else {
      text += TableMarkdown(std::get<Table>(block));
    }
  }
  return text;
}

std::string SectionHtml(const ReportSection& section) {
  std::string html;
  for (const auto& block : section.blocks) {
    if (const auto* paragraph = std::get_if<Paragraph>(&block)) {
      html += "<p>" + EscapeXml(*paragraph) + "</p>\n";
    } else if (const auto* list = std::get_if<BulletList>(&block)) {
      html += "<ul>\n";
      for (const std::string& item : *list) html += "<li>" + EscapeXml(item) + "</li>\n";
      html += "</ul>\n";
    } else {
      html += TableHtml(std::get<Table>(block));
    }
  }
  return html;
}

}  // namespace frond
