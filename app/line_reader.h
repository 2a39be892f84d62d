#pragma once
// Lines from a file or from standard input, read as they arrive.

#include <filesystem>
#include <string>

namespace lightbench {

/// Knows whether the next line is there already or would have to be waited for, so that a program
/// on the other end of a pipe gets its answers before it asks on.
class LineReader {
 public:
  /// An empty name is standard input. Throws Error{Scene} if the file cannot be opened.
  explicit LineReader(const std::filesystem::path& file);
  ~LineReader();
  LineReader(const LineReader&) = delete;
  LineReader& operator=(const LineReader&) = delete;

  /// The next line without its end, or false at the end of input. Throws Error{Scene}.
  bool next(std::string& line);
  /// True if next() would have to wait for input.
  [[nodiscard]] bool would_wait();
  /// Of the line that next() gave last, counted from 1.
  [[nodiscard]] int line_number() const { return line_number_; }
  /// File name, or "standard input".
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  bool read_more();

  std::string name_;
  int file_ = -1;
  bool own_ = false;
  bool ended_ = false;
  std::string buffer_;
  std::size_t begin_ = 0;    ///< of what next() has not given yet
  std::size_t scanned_ = 0;  ///< no line ends between begin_ and here
  int line_number_ = 0;
};

}  // namespace lightbench
