// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mpi.h>

#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "seam/base/diagnostics.hpp"

namespace seam {

/// The group of processes that solve one scene together, with the few collective operations Seam needs.
class Communicator {
 public:
  Communicator() : Communicator(MPI_COMM_WORLD) {}
  explicit Communicator(MPI_Comm handle) : handle_(handle) {
    MPI_Comm_rank(handle, &rank_);
    MPI_Comm_size(handle, &size_);
  }
  [[nodiscard]] int rank() const { return rank_; }
  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] MPI_Comm handle() const { return handle_; }

  [[nodiscard]] double sum(double value) const { return reduce(value, MPI_DOUBLE, MPI_SUM); }
  [[nodiscard]] double max(double value) const { return reduce(value, MPI_DOUBLE, MPI_MAX); }
  [[nodiscard]] double min(double value) const { return reduce(value, MPI_DOUBLE, MPI_MIN); }
  [[nodiscard]] long long sum(long long value) const { return reduce(value, MPI_LONG_LONG, MPI_SUM); }
  [[nodiscard]] int max(int value) const { return reduce(value, MPI_INT, MPI_MAX); }
  [[nodiscard]] bool any(bool value) const { return max(value ? 1 : 0) != 0; }
  void sum(std::vector<double>& values) const { reduce(values, MPI_SUM); }
  void max(std::vector<double>& values) const { reduce(values, MPI_MAX); }
  /// Sum of the values of all lower ranks.
  [[nodiscard]] long long sum_before(long long value) const {
    long long result = 0;
    MPI_Exscan(&value, &result, 1, MPI_LONG_LONG, MPI_SUM, handle_);
    return rank_ == 0 ? 0 : result;
  }

  /// Sends `out[r]` to every rank r; returns what each rank sent here. T must be trivially copyable.
  template <class T>
  [[nodiscard]] std::vector<std::vector<T>> exchange(const std::vector<std::vector<T>>& out) const {
    std::vector<int> out_count(size_), in_count(size_);
    for (int r = 0; r < size_; ++r) out_count[r] = bytes_of(out[r]);
    MPI_Alltoall(out_count.data(), 1, MPI_INT, in_count.data(), 1, MPI_INT, handle_);
    std::vector<std::vector<T>> in(size_);
    std::vector<MPI_Request> requests;
    for (int r = 0; r < size_; ++r) {
      in[r].resize(in_count[r] / sizeof(T));
      if (in_count[r] > 0)
        MPI_Irecv(in[r].data(), in_count[r], MPI_BYTE, r, 17, handle_, &requests.emplace_back());
      if (out_count[r] > 0)
        MPI_Isend(out[r].data(), out_count[r], MPI_BYTE, r, 17, handle_, &requests.emplace_back());
    }
    MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
    return in;
  }

  /// The concatenation of every rank's entries, in rank order, on every rank.
  template <class T>
  [[nodiscard]] std::vector<T> gather_all(const std::vector<T>& mine) const {
    std::vector<int> count(size_), offset(size_);
    const int bytes = bytes_of(mine);
    MPI_Allgather(&bytes, 1, MPI_INT, count.data(), 1, MPI_INT, handle_);
    check_bytes(std::accumulate(count.begin(), count.end(), 0LL));
    for (int r = 1; r < size_; ++r) offset[r] = offset[r - 1] + count[r - 1];
    std::vector<T> all((offset[size_ - 1] + count[size_ - 1]) / sizeof(T));
    MPI_Allgatherv(mine.data(), bytes, MPI_BYTE, all.data(), count.data(), offset.data(), MPI_BYTE, handle_);
    return all;
  }

 private:
  /// MPI counts with int.
  static void check_bytes(long long bytes) {
    if (bytes > std::numeric_limits<int>::max())
      throw Error("a message of " + std::to_string(bytes) +
                  " bytes is beyond the 2 GiB that MPI sends at once: take more ranks, or a smaller mesh");
  }
  template <class T>
  [[nodiscard]] static int bytes_of(const std::vector<T>& values) {
    check_bytes(
        static_cast<long long>(values.size() * sizeof(T)));  // NOLINT(bugprone-misplaced-widening-cast)
    return static_cast<int>(values.size() * sizeof(T));
  }
  void reduce(std::vector<double>& values, MPI_Op operation) const {
    MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, operation,
                  handle_);
  }
  template <class T>
  [[nodiscard]] T reduce(T value, MPI_Datatype type, MPI_Op operation) const {
    T result{};
    MPI_Allreduce(&value, &result, 1, type, operation, handle_);
    return result;
  }
  MPI_Comm handle_;
  int rank_ = 0;
  int size_ = 1;
};

}  // namespace seam
