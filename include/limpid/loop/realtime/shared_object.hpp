// SPDX-License-Identifier: MIT
#pragma once

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <utility>

namespace limpid {

/// An object that two processes share by a name: one makes it, one at a time uses it.
/// ```cpp
/// auto shared = SharedObject<EnvironmentExchange<>>::make("/tissue");  // the loop's process
/// auto shared = SharedObject<EnvironmentExchange<>>::use("/tissue");   // the environment's
/// EnvironmentEnd end(*shared);
/// ```
/// The memory tells who made it for what: its size, and `T::layout()`; a program that was built for something else is
/// refused in words. Who is killed leaves its place to the next one; who has only stopped keeps it, so that no two ever
/// write as one, and must be killed first. The name is gone when its maker ends, and where that was killed, the next
/// maker takes it over. Places are locks of Linux on the open file: a child that is forked has its parent's as long as
/// it lives, or until it execs.
/// @tparam T  holds no pointers; `static std::string layout()`, below 128 characters
template <typename T>
class SharedObject {
 public:
  /// @param name  "/" and up to 254 characters that are not "/"
  /// @throws std::runtime_error  where another process that lives has made it, or memory cannot be had
  [[nodiscard]] static SharedObject make(const std::string& name) {
    SharedObject shared(name, O_CREAT | O_EXCL);
    if (shared.file_ < 0 && errno == EEXIST) {
      shared = SharedObject(name, 0);
      if (shared.file_ >= 0) shared.take(maker, "has made it");
      shm_unlink(name.c_str());
      shared = SharedObject(name, O_CREAT | O_EXCL);
    }
    shared.check(shared.file_ >= 0);
    shared.take(maker, "is making it");
    shared.maker_ = getpid();
    shared.check(ftruncate(shared.file_, sizeof(Block)) == 0);
    shared.map();
    shared.construct();
    return shared;
  }

  /// @throws std::runtime_error  where nobody has made it, it was made for something else, or another process uses it
  [[nodiscard]] static SharedObject use(const std::string& name) {
    SharedObject shared(name, 0);
    shared.refuse(shared.file_ < 0 && errno == ENOENT, "no process has made it");
    shared.check(shared.file_ >= 0);
    struct stat found {};
    shared.check(fstat(shared.file_, &found) == 0);
    const auto size = static_cast<std::uint64_t>(found.st_size);
    shared.refuse(size != sizeof(Block), "expected " + expected() + ", in " + std::to_string(sizeof(Block)) +
                                             " bytes, got " + std::to_string(size) + " bytes");
    shared.map();
    shared.refuse(shared.block_->made.load(std::memory_order_acquire) != magic,
                  "expected " + expected() + ", got what limpid has not made, or not yet");
    const std::string_view layout(shared.block_->layout.data());
    shared.refuse(layout != expected(), "expected " + expected() + ", got " + std::string(layout));
    shared.take(user, "uses it");
    shared.block_->processes[user] = getpid();
    return shared;
  }

  SharedObject(SharedObject&& other) noexcept { swap(other); }
  SharedObject& operator=(SharedObject&& other) noexcept {
    swap(other);
    return *this;
  }
  SharedObject(const SharedObject&) = delete;
  SharedObject& operator=(const SharedObject&) = delete;

  ~SharedObject() {
    if (maker_ == getpid()) shm_unlink(name_.c_str());
    if (block_ != nullptr) munmap(block_, sizeof(Block));
    if (file_ >= 0) close(file_);
  }

  [[nodiscard]] T& operator*() const noexcept { return block_->object; }
  [[nodiscard]] T* operator->() const noexcept { return &block_->object; }

 private:
  static constexpr std::uint64_t magic = 0x6469706d696c;  // "limpid"
  static constexpr std::size_t maker = 0, user = 1;       // places

  struct Block {
    std::array<char, 128> layout{};
    std::array<std::atomic<pid_t>, 2> processes{};  // that have the places, for words
    std::atomic<std::uint64_t> made = 0;            // the magic, when all of it is there
    T object{};
  };
  static_assert(std::is_trivially_destructible_v<Block>);

  static std::string expected() { return T::layout(); }

  SharedObject(std::string name, int flags)
      : name_{std::move(name)}, file_{shm_open(name_.c_str(), O_RDWR | O_CLOEXEC | flags, S_IRUSR | S_IWUSR)} {}

  void swap(SharedObject& other) noexcept {
    std::swap(name_, other.name_);
    std::swap(file_, other.file_);
    std::swap(block_, other.block_);
    std::swap(maker_, other.maker_);
  }

  void refuse(bool condition, const std::string& why) const {
    if (condition) throw std::runtime_error("SharedObject " + name_ + ": " + why);
  }
  void check(bool done) const {
    const int error = errno;
    refuse(!done, std::system_category().message(error));
  }

  void map() {
    void* const memory = mmap(nullptr, sizeof(Block), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_POPULATE, file_, 0);
    check(memory != MAP_FAILED);
    block_ = static_cast<Block*>(memory);
  }

  void construct() {
    std::construct_at(block_);
    const std::string layout = expected();
    refuse(layout.size() >= block_->layout.size(), "expected a layout below 128 characters, got " + layout);
    std::copy(layout.begin(), layout.end(), block_->layout.begin());
    block_->processes[maker] = getpid();
    block_->made.store(magic, std::memory_order_release);
  }

  // Locks the byte of a place, which its process loses by ending in whatever way.
  void take(std::size_t place, const std::string& does) const {
    struct flock lock {};
    lock.l_type = F_WRLCK;
    lock.l_whence = SEEK_SET;
    lock.l_start = static_cast<off_t>(place);
    lock.l_len = 1;
    if (fcntl(file_, F_OFD_SETLK, &lock) == 0) return;  // NOLINT(*-vararg)
    check(errno == EAGAIN || errno == EACCES);
    const std::string who =
        block_ == nullptr ? "another process" : "process " + std::to_string(block_->processes[place].load());
    refuse(true, who + ' ' + does + "; it must end first");
  }

  std::string name_;
  int file_ = -1;
  Block* block_ = nullptr;
  pid_t maker_ = 0;  // who is to remove the name
};

}  // namespace limpid
