// SPDX-License-Identifier: BSD-3-Clause
// Every code block of the two documents on extending frond is a part of the sources that are compiled here:
// an example that changes in one place alone fails.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "experiments/sweep.h"
#include "io/file_bytes.h"

namespace frond {
namespace {

constexpr std::size_t kBlockIndent = 4;  // of Markdown

const std::filesystem::path kDocuments = std::filesystem::path(FROND_SOURCE_DIR) / "docs";

// The lines of a text, without blanks at their ends.
std::vector<std::string> Lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    line.erase(line.find_last_not_of(" \t\r") + 1);
    lines.push_back(line);
  }
  return lines;
}

// Without the blanks that all lines begin with, each line with its end.
std::string Dedented(const std::vector<std::string>& lines) {
  std::size_t indent = std::string::npos;
  for (const std::string& line : lines) indent = std::min(indent, line.find_first_not_of(' '));
  std::string text;
  for (const std::string& line : lines) text += (line.empty() ? "" : line.substr(indent)) + "\n";
  return text;
}

struct Block {
  std::size_t line = 0;  // of the document, from 1
  std::vector<std::string> lines;
};

// A block is made of lines indented by four blanks after an empty line, with the empty lines between them.
std::vector<Block> CodeBlocks(const std::vector<std::string>& document) {
  std::vector<Block> blocks;
  bool inside = false;
  std::size_t empty = 1;  // lines in a row
  for (std::size_t k = 0; k < document.size(); ++k) {
    const std::string& line = document[k];
    if (line.empty()) {
      ++empty;
      continue;
    }
    const bool indented = line.starts_with(std::string(kBlockIndent, ' '));
    if (indented && !inside && empty > 0) blocks.push_back({k + 1, {}});
    inside = indented && (inside || empty > 0);
    if (inside) {
      std::vector<std::string>& lines = blocks.back().lines;
      if (!lines.empty()) lines.insert(lines.end(), empty, "");
      lines.push_back(line);
    }
    empty = 0;
  }
  return blocks;
}

// Whether the block, moved left or right as a whole, stands in the source.
bool Holds(const std::vector<std::string>& source, const Block& block) {
  const std::string wanted = Dedented(block.lines);
  const std::size_t size = block.lines.size();
  for (std::size_t k = 0; k + size <= source.size(); ++k) {
    const auto begin = source.begin() + static_cast<std::ptrdiff_t>(k);
    if (Dedented({begin, begin + static_cast<std::ptrdiff_t>(size)}) == wanted) return true;
  }
  return false;
}

class ExtensionDocument : public testing::TestWithParam<const char*> {};

TEST_P(ExtensionDocument, EveryCodeBlock_IsAPartOfTheCompiledSources) {
  std::vector<std::vector<std::string>> sources;
  for (const auto& entry : std::filesystem::directory_iterator(kDocuments / "examples")) {
    sources.push_back(Lines(ReadFileBytes(entry.path())));
  }
  const std::vector<Block> blocks =
      CodeBlocks(Lines(ReadFileBytes(kDocuments / (GetParam() + std::string(".md")))));
  EXPECT_FALSE(blocks.empty());
  for (const Block& block : blocks) {
    const bool found =
        std::any_of(sources.begin(), sources.end(), [&](const auto& source) { return Holds(source, block); });
    EXPECT_TRUE(found) << "docs/" << GetParam() << ".md:" << block.line
                       << ": this block is in no file of docs/examples:\n"
                       << Dedented(block.lines);
  }
}

INSTANTIATE_TEST_SUITE_P(All, ExtensionDocument, testing::Values("add_a_fit", "add_a_solver"),
                         [](const auto& info) { return std::string(info.param); });

TEST(StudiesDocument, ShowsItsConfig_WhichIsRight) {
  const std::filesystem::path config = kDocuments / "examples/first_study.yaml";
  const std::string wanted = Dedented(Lines(ReadFileBytes(config)));
  const std::vector<Block> blocks = CodeBlocks(Lines(ReadFileBytes(kDocuments / "studies.md")));
  EXPECT_TRUE(std::any_of(blocks.begin(), blocks.end(), [&](const Block& block) {
    return wanted.ends_with(Dedented(block.lines));  // but for the comment on top
  }));
  EXPECT_EQ(CheckConfig(config, {}), 2U * 4U * 15U);
}

TEST(CodeBlocks, AreFoundWithTheirEmptyLines_AndListsAreNone) {
  const std::vector<Block> blocks =
      CodeBlocks(Lines("text\n\n    a {\n\n      b\n    }\n\n- item\n    goes on\n\n    c  \n"));
  ASSERT_EQ(blocks.size(), 2U);
  EXPECT_EQ(blocks[0].line, 3U);
  EXPECT_EQ(Dedented(blocks[0].lines), "a {\n\n  b\n}\n");
  EXPECT_EQ(Dedented(blocks[1].lines), "c\n");
}

TEST(CodeBlocks, ThatDifferInOneCharacter_AreNotHeld) {
  const std::vector<std::string> source = Lines("  if (x) {\n    y();\n  }\n");
  EXPECT_TRUE(Holds(source, {1, {"    if (x) {", "      y();", "    }"}}));
  EXPECT_FALSE(Holds(source, {1, {"    if (x) {", "      z();", "    }"}}));
  EXPECT_FALSE(Holds(source, {1, {"    if (x) {", "    y();", "    }"}}));
}

}  // namespace
}  // namespace frond
