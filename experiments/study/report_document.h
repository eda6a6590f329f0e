// SPDX-License-Identifier: BSD-3-Clause
// A report as sections of paragraphs, lists and tables, and its renderings: whatever is shown is written
// once.
#pragma once

#include <cstddef>
#include <string>
#include <variant>
#include <vector>

namespace frond {

struct TableCell {
  std::string text;
  bool strong = false;  // the best of its row or column
};

struct Table {
  struct Column {
    std::string name;
    bool number = true;  // set to the right
  };
  std::string caption;  // plain text; how to read it
  std::vector<Column> columns;
  std::vector<std::vector<TableCell>> rows;  // the first cell heads its row
};

using Paragraph = std::string;
using BulletList = std::vector<std::string>;

struct ReportSection {
  std::string id, title;
  std::vector<std::variant<Paragraph, BulletList, Table>> blocks;
};

std::string TableMarkdown(const Table& table);
std::string TableHtml(const Table& table);

// For a terminal: columns `shown` of the table, headers broken at spaces. Where that is wider than `width`,
// the texts of the first column are shortened, to 8 characters at least.
std::string TableText(const Table& table, const std::vector<std::size_t>& shown, std::size_t width);

std::string SectionMarkdown(const ReportSection& section);  // under "## TITLE"
std::string SectionHtml(const ReportSection& section);      // what is under its heading

}  // namespace frond
