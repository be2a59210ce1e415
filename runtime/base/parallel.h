// runtime/base/parallel.h: run a range on the machine's cores. oneTBB underneath (one pool, shared
// with Embree), in a module that is opened by the first loop of several threads: it is slow to
// include and to load.
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>

namespace kinora {

// A view of a callable, valid while the callable lives; no allocation.
template <class Signature>
class FunctionRef;
template <class R, class... Args>
class FunctionRef<R(Args...)> {
  public:
    template <class F>
    requires(!std::is_same_v<std::remove_cvref_t<F>, FunctionRef>) FunctionRef(F&& f)
        : object_(const_cast<void*>(static_cast<const void*>(std::addressof(f)))),
          call_([](void* object, Args... args) -> R {
              return (*static_cast<std::remove_reference_t<F>*>(object))(
                  std::forward<Args>(args)...);
          }) {}
    R operator()(Args... args) const { return call_(object_, std::forward<Args>(args)...); }

  private:
    void* object_;
    R (*call_)(void*, Args...);
};

// Bounds the threads that all later parallel work uses, the calling one included; n >= 1. Before
// the first call they are usable_cores(). While a loop runs, only to what it is already, which does
// nothing.
void set_thread_count(int n);
int thread_count();

// Index of the calling thread among the workers, 0 <= index < thread_count(): stable inside one
// parallel_for body, for per-thread arenas.
int thread_index();

// Opens the module now. Before other libraries that use oneTBB: thread_count() then binds them too.
// Where it cannot be opened, which stderr is told, all loops run on the thread that calls.
void open_task_scheduler();

// Calls body(begin, end) for disjoint ranges covering [first, last), each at least `grain` long
// where possible; runs inline when one range is enough or one thread is set. Not for use below
// RendererServices (no task is started below shade()).
void parallel_for(size_t first, size_t last, size_t grain,
                  FunctionRef<void(size_t begin, size_t end)> body);

// For its scope, parallel_for runs inline on this thread: for work in the background, which must
// neither wait for the threads of the frame nor be handed to them.
class SerialScope {
  public:
    SerialScope();
    ~SerialScope();
    SerialScope(const SerialScope&) = delete;

  private:
    bool before_;
};

}  // namespace kinora
