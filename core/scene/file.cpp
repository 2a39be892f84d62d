#include "core/scene/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <system_error>
#include <utility>

#include "core/error.h"

namespace lightbench {
namespace {

constexpr std::size_t kLargestFile = std::size_t{1} << 34;

std::string reason(int code) { return std::generic_category().message(code); }

/// Closes on every way out.
class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(Descriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  Descriptor& operator=(Descriptor&&) = delete;
  [[nodiscard]] int get() const { return fd_; }
  /// False with errno set if the last write failed only now.
  bool close() { return ::close(std::exchange(fd_, -1)) == 0; }

 private:
  int fd_;
};

bool write_all(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

/// Unlike any other in this process and, by its process id, in others.
std::filesystem::path temporary_name(const std::filesystem::path& file) {
  static std::atomic<unsigned> counter{0};
  return file.parent_path() / ("." + file.filename().string() + "." + std::to_string(::getpid()) +
                               "." + std::to_string(counter++) + ".tmp");
}

[[noreturn]] void fail_reading(const std::filesystem::path& file, const std::string& why) {
  throw Error(ErrorKind::Scene, file.string() + ": cannot be read: " + why);
}

struct OpenFile {
  Descriptor descriptor;
  std::size_t size;
};

OpenFile open_for_reading(const std::filesystem::path& file) {
  // Not blocking, or opening a pipe would wait for its writer.
  Descriptor descriptor(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (descriptor.get() < 0) fail_reading(file, reason(errno));
  struct stat status {};
  if (::fstat(descriptor.get(), &status) != 0) fail_reading(file, reason(errno));
  if (!S_ISREG(status.st_mode)) fail_reading(file, "not a regular file");
  const auto size = static_cast<std::size_t>(status.st_size);
  if (size > kLargestFile) fail_reading(file, "larger than 16 GiB");
  return {std::move(descriptor), size};
}

}  // namespace

std::string read_file(const std::filesystem::path& file) {
  const OpenFile open = open_for_reading(file);
  std::string bytes(open.size, '\0');
  std::size_t used = 0;
  while (used < bytes.size()) {
    const ssize_t got = ::read(open.descriptor.get(), bytes.data() + used, bytes.size() - used);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail_reading(file, reason(errno));
    if (got == 0) break;  // it became shorter meanwhile
    used += static_cast<std::size_t>(got);
  }
  bytes.resize(used);
  return bytes;
}

void check_readable(const std::filesystem::path& file) {
  static_cast<void>(open_for_reading(file));
}

void replace_file(const std::filesystem::path& file, std::string_view bytes) {
  const auto fail = [&](const std::string& why) {
    throw Error(ErrorKind::Output, file.string() + ": cannot be written: " + why);
  };
  std::error_code ignored;
  std::filesystem::path target = file;
  if (std::filesystem::is_symlink(target, ignored)) {
    const auto resolved = std::filesystem::weakly_canonical(target, ignored);
    if (!ignored) target = resolved;
  }
  mode_t mode = 0;
  if (struct stat status{}; ::stat(target.c_str(), &status) == 0) {
    // Renaming over a device or a pipe would destroy it.
    if (!S_ISREG(status.st_mode)) fail("it exists and is not a regular file");
    mode = status.st_mode & 07777U;
  }
  const std::filesystem::path temporary = temporary_name(target);
  Descriptor descriptor(
      ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode_t{0666}));
  if (descriptor.get() < 0) fail(reason(errno));
  if (mode != 0) static_cast<void>(::fchmod(descriptor.get(), mode));
  if (!write_all(descriptor.get(), bytes) || ::fsync(descriptor.get()) != 0 ||
      !descriptor.close() || ::rename(temporary.c_str(), target.c_str()) != 0) {
    const std::string why = reason(errno);
    ::unlink(temporary.c_str());
    fail(why);
  }
}

}  // namespace lightbench
