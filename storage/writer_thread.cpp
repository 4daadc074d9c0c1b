#include "storage/writer_thread.hpp"

#include <exception>
#include <stdexcept>

namespace raywatch {

struct WriterThread::Item {
  const std::function<void()>& work;
  bool done = false;
  std::exception_ptr failure = nullptr;
};

WriterThread::WriterThread() : thread_([this](const std::stop_token& stop) { serve(stop); }) {}

WriterThread::~WriterThread() = default;

void WriterThread::run(const std::function<void()>& work) {
  if (std::this_thread::get_id() == thread_.get_id()) {
    throw std::logic_error("the store was called from inside one of its transactions");
  }
  Item item{work};
  std::unique_lock lock(mutex_);
  queue_.push_back(&item);
  arrived_.notify_one();
  finished_.wait(lock, [&] { return item.done; });
  lock.unlock();
  if (item.failure) std::rethrow_exception(item.failure);
}

void WriterThread::serve(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (arrived_.wait(lock, stop, [&] { return !queue_.empty(); })) {
    Item* item = queue_.front();
    queue_.pop_front();
    lock.unlock();
    try {
      item->work();
    } catch (...) {
      item->failure = std::current_exception();
    }
    lock.lock();
    item->done = true;
    finished_.notify_all();
  }
}

}  // namespace raywatch
