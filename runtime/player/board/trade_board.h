// runtime/player/board/trade_board.h: one view in several qualities: what each picture took, and
// its errors against the best one that was made. Errors are computed on a thread of its own.
#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "raytrace/film.h"

namespace kinora {

struct TradeStop {
    std::string name;     // "quick", or a preset
    int rank = 0;         // grows with the quality
    double ms = 0;        // that its picture took
    std::string against;  // the stop that its errors are measured against; "" not measured
    double rmse = 0;      // of linear colors: runtime/picture/compare/errors.h
    double flip = 0;      // mean of ldr_flip
};

class TradeBoard {
  public:
    // `wake` is called from the thread when errors have come.
    explicit TradeBoard(std::function<void()> wake);
    ~TradeBoard();
    TradeBoard(const TradeBoard&) = delete;

    // Another view, or another scene.
    void clear();
    // The picture of a stop, in place of the one before. Films have equal sizes.
    void add(const std::string& name, int rank, double ms,
             std::shared_ptr<const raytrace::Film> film);
    std::vector<TradeStop> stops() const;  // by rank
    bool idle() const;                     // all errors are there

  private:
    struct Row {
        TradeStop stop;
        std::shared_ptr<const raytrace::Film> film;
        bool due = false;  // its errors are to be computed
    };
    void run();
    Row* due_row();  // with the lock

    std::function<void()> wake_;
    mutable std::mutex mutex_;
    std::condition_variable wanted_;
    std::vector<Row> rows_;
    uint64_t edition_ = 0;  // grows with each change of the rows
    bool working_ = false, quit_ = false;
    std::thread thread_;
};

}  // namespace kinora
