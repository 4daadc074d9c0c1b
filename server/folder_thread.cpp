#include <poll.h>
#include <spdlog/spdlog.h>
#include <sys/eventfd.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <array>
#include <stop_token>

#include "core/error.hpp"
#include "server/folder_intake.hpp"

namespace raywatch {
namespace {

using Clock = FolderIntake::Clock;

/// A file descriptor, closed at the end.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }

 private:
  int number_;
};

/// What the system says about a folder. Where it says nothing, as of NFS, looking now and then must do.
class FolderNotices {
 public:
  FolderNotices() : inotify_(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC)) {}

  /// The folder may have been made, or made anew.
  void watch(const std::filesystem::path& folder) {
    constexpr std::uint32_t kEvents = IN_CREATE | IN_CLOSE_WRITE | IN_MOVED_TO | IN_ONLYDIR;
    ::inotify_add_watch(inotify_.number(), folder.c_str(), kEvents);
  }
  int descriptor() const { return inotify_.number(); }

  /// Takes what was said; tells the names that files were renamed to.
  void take(FolderIntake& intake) const {
    alignas(inotify_event) std::array<char, 16384> bytes;
    ssize_t size = 0;
    while ((size = ::read(inotify_.number(), bytes.data(), bytes.size())) > 0) {
      for (ssize_t at = 0; at < size;) {
        const auto* event = reinterpret_cast<const inotify_event*>(bytes.data() + at);
        if ((event->mask & IN_MOVED_TO) != 0 && event->len > 0) intake.note_renamed(event->name);
        at += static_cast<ssize_t>(sizeof(inotify_event) + event->len);
      }
    }
  }

 private:
  Descriptor inotify_;
};

/// Waits for a stop, and for a notice if `notices` is one. @returns whether there is a notice.
bool wait(int stopped, int notices, Clock::time_point until) {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now());
  if (left.count() <= 0) return false;
  std::array<pollfd, 2> events{pollfd{stopped, POLLIN, 0}, pollfd{notices, POLLIN, 0}};
  return ::poll(events.data(), events.size(), static_cast<int>(std::min<std::int64_t>(left.count(), 60'000))) > 0 &&
         events[1].revents != 0;
}

Clock::time_point look_logged(FolderIntake& intake) {
  try {
    return intake.look(Clock::now());
  } catch (const std::exception& error) {
    constexpr std::chrono::seconds kRest{5};
    spdlog::error("folder {}: {}", intake.config().path.string(), error.what());
    return Clock::now() + kRest;
  }
}

void look_until_stopped(FolderIntake& intake, const std::stop_token& stop) {
  /// Notices come in bursts.
  constexpr std::chrono::milliseconds kApart{50};
  const Descriptor stopped(::eventfd(0, EFD_CLOEXEC));
  const std::stop_callback wake(stop, [&] { ::eventfd_write(stopped.number(), 1); });
  FolderNotices notices;
  while (!stop.stop_requested()) {
    notices.watch(intake.config().path);
    notices.take(intake);
    const Clock::time_point next = look_logged(intake);
    wait(stopped.number(), -1, Clock::now() + kApart);
    if (!stop.stop_requested()) wait(stopped.number(), notices.descriptor(), next);
  }
}

}  // namespace

FolderThread::FolderThread(std::unique_ptr<FolderIntake> intake)
    : intake_(std::move(intake)),
      thread_([this](const std::stop_token& stop) { look_until_stopped(*intake_, stop); }) {}

}  // namespace raywatch
