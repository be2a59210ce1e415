// runtime/base/memory/shared_vector.h: a vector that all its copies share.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace kinora {

// A copy is another owner of the same elements. They change only while there is one owner: whoever
// fills the vector does so before it is copied.
template <class T>
class SharedVector {
  public:
    SharedVector() : items_(std::make_shared<std::vector<T>>()) {}
    SharedVector& operator=(std::vector<T> items) {
        items_ = std::make_shared<std::vector<T>>(std::move(items));
        return *this;
    }
    operator const std::vector<T>&() const { return *items_; }

    size_t size() const { return items_->size(); }
    bool empty() const { return items_->empty(); }
    const T* data() const { return items_->data(); }
    T* data() { return items_->data(); }
    const T& operator[](size_t k) const { return (*items_)[k]; }
    T& operator[](size_t k) { return (*items_)[k]; }
    const T& front() const { return items_->front(); }
    T& front() { return items_->front(); }
    const T& back() const { return items_->back(); }
    T& back() { return items_->back(); }
    auto begin() const { return std::as_const(*items_).begin(); }
    auto begin() { return items_->begin(); }
    auto end() const { return std::as_const(*items_).end(); }
    auto end() { return items_->end(); }

    void push_back(T item) { items_->push_back(std::move(item)); }
    template <class... Args>
    T& emplace_back(Args&&... args) {
        return items_->emplace_back(std::forward<Args>(args)...);
    }
    void resize(size_t size) { items_->resize(size); }
    void reserve(size_t size) { items_->reserve(size); }
    void clear() { items_->clear(); }

  private:
    std::shared_ptr<std::vector<T>> items_;
};

}  // namespace kinora
