#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace raywatch {

/// Walks over the lines of a text. Lines end with LF, CR LF or the end of the text.
class TextLines {
 public:
  explicit TextLines(std::string_view text) : text_(text) {}

  /// Steps to the next line. @returns false at the end of the text.
  bool next();
  std::string_view line() const { return line_; }
  std::size_t number() const { return number_; }  ///< of the line, from 1
  std::size_t offset() const { return next_; }    ///< in the text, of what follows the line
  std::size_t bytes_left() const { return text_.size() - next_; }

 private:
  std::string_view text_, line_;
  std::size_t next_ = 0;
  std::size_t number_ = 0;
};

/// Replaces `words` by the parts of `line` between blanks and tabs.
void split_words(std::string_view line, std::vector<std::string_view>& words);

/// Replaces `cells` by the parts of `line` between `separator`s, without blanks around them. May be empty each.
void split_cells(std::string_view line, char separator, std::vector<std::string_view>& cells);

std::string_view trimmed(std::string_view text);
std::string lower_case(std::string_view text);

/// `text` for a message: quoted, cut when long, unprintable bytes replaced.
std::string shown(std::string_view text);

/// "line 12: ", for messages.
std::string at_line(std::size_t number);

/// The whole of `text` as a number, if it is one that fits; "nan" and "inf" are, and a leading plus is allowed.
std::optional<double> try_parse_real(std::string_view text);

/// @{ The same for text that must be a number.
/// @throws InvalidInput naming `line` when it is none or does not fit.
double parse_real(std::string_view text, std::size_t line);
std::uint64_t parse_count(std::string_view text, std::size_t line);
/// @}

}  // namespace raywatch
