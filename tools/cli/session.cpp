// SPDX-License-Identifier: BSD-3-Clause
#include "session.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <mpi.h>

#include <chrono>
#include <cstdlib>
#include <thread>

#include "command.hpp"
#include "seam/base/all_or_none.hpp"
#include "seam/base/communicator.hpp"
#include "seam/base/stopwatch.hpp"

namespace seam::cli {
namespace {

/// A communicator for the agreement alone: the ranks that are well may be within a collective of the other
/// one.
MPI_Comm failures = MPI_COMM_NULL;

/// True when all ranks come here within some seconds. Ranks throw the same error at almost the same time; one
/// that waits for us in a collective operation never comes.
bool all_ranks_come() {
  constexpr double patience = 5;
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Ibarrier(failures, &request);
  int done = 0;
  for (const Stopwatch watch; watch.seconds() < patience;) {
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    if (done) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

/// One thread a rank, unless the environment says otherwise: BLAS threads would fight over the cores.
/// OpenBLAS has read its variables by now, hence its function, where it is the BLAS that is used.
void use_one_blas_thread() {
  if (std::getenv("OPENBLAS_NUM_THREADS") || std::getenv("OMP_NUM_THREADS")) return;
  setenv("OPENBLAS_NUM_THREADS", "1", 0);  // for the programs that are started
  using SetThreads = void (*)(int);
  if (const auto set = reinterpret_cast<SetThreads>(dlsym(RTLD_DEFAULT, "openblas_set_num_threads"))) set(1);
}

}  // namespace

std::string agree_on_exception() {
  const Failure failure = current_failure();
  int size = 1, rank = 0;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (size == 1) return failure.message;
  if (all_ranks_come()) return distinct_texts(Communicator(failures), failure.message);
  fmt::print(stderr, "{}\n(on rank {} of {} only: all are stopped)\n", failure.message, rank, size);
  std::fflush(nullptr);
  MPI_Abort(MPI_COMM_WORLD, failure.code);
  std::abort();  // not reached
}

int run_on_all_ranks(const std::function<int(bool)>& action) {
  use_one_blas_thread();
  MPI_Init(nullptr, nullptr);
  MPI_Comm_dup(MPI_COMM_WORLD, &failures);
  const bool is_root = Communicator().rank() == 0;
  int code = ok;
  try {
    code = action(is_root);
  } catch (...) {
    code = current_failure().code;
    const std::string message = agree_on_exception();
    if (is_root) fmt::print(stderr, "{}\n", message);
  }
  MPI_Comm_free(&failures);
  MPI_Finalize();
  return code;
}

}  // namespace seam::cli
