// rsl/syntax/nesting.h: how deep expressions and statements stand in one another.
#pragma once

namespace kinora::rsl {

inline constexpr int kMostNesting = 400;

class Nesting {
  public:
    // One level deeper for the life of the guard.
    class Level {
      public:
        explicit Level(Nesting& nesting) : depth_(nesting.depth_) { ++depth_; }
        ~Level() { --depth_; }
        Level(const Level&) = delete;

      private:
        int& depth_;
    };
    bool too_deep() const { return depth_ > kMostNesting; }

  private:
    int depth_ = 0;
};

}  // namespace kinora::rsl
