#include "app/line_reader.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/error.h"

namespace lightbench {

LineReader::LineReader(const std::filesystem::path& file)
    : name_(file.empty() ? "standard input" : file.string()), own_(!file.empty()) {
  file_ = own_ ? open(file.c_str(), O_RDONLY | O_CLOEXEC) : STDIN_FILENO;
  if (file_ < 0) {
    throw Error(ErrorKind::Scene,
                fmt::format("{}: cannot be opened: {}", name_, std::strerror(errno)));
  }
}

LineReader::~LineReader() {
  if (own_) close(file_);
}

bool LineReader::next(std::string& line) {
  for (;;) {
    const std::size_t end = buffer_.find('\n', scanned_);
    if (end != std::string::npos || ended_) {
      if (end == std::string::npos && begin_ == buffer_.size()) return false;
      line = buffer_.substr(begin_, end == std::string::npos ? end : end - begin_);
      begin_ = scanned_ = end == std::string::npos ? buffer_.size() : end + 1;
      ++line_number_;
      return true;
    }
    scanned_ = buffer_.size();
    ended_ = !read_more();
  }
}

bool LineReader::would_wait() {
  if (ended_ || buffer_.find('\n', scanned_) != std::string::npos) return false;
  pollfd ready{file_, POLLIN, 0};
  return poll(&ready, 1, 0) == 0;
}

bool LineReader::read_more() {
  buffer_.erase(0, begin_);
  scanned_ -= begin_;
  begin_ = 0;
  char block[65536];
  ssize_t count = 0;
  do {
    count = read(file_, block, sizeof block);
  } while (count < 0 && errno == EINTR);
  if (count < 0) {
    throw Error(ErrorKind::Scene, fmt::format("{}: {}", name_, std::strerror(errno)));
  }
  buffer_.append(block, static_cast<std::size_t>(count));
  return count > 0;
}

}  // namespace lightbench
