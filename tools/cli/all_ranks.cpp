// SPDX-License-Identifier: BSD-3-Clause
#include "all_ranks.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <thread>
#include <vector>

#include "command.hpp"
#include "crash.hpp"
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

/// MPI_Init. Where no launcher has started us, Open MPI would start a daemon, which takes 0.1 s, try every
/// kind of network, 0.2 s, and make folders below the one for temporary files that processes which begin and
/// end at the same time remove for each other: one of some thousand starts failed. A process alone needs none
/// of these. Children are not to know.
void start_mpi() {
  constexpr std::array launchers{"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMIX_NAMESPACE", "PMI_RANK"};
  constexpr std::array<std::array<const char*, 2>, 4> alone{{{"OMPI_MCA_ess_singleton_isolated", "1"},
                                                             {"OMPI_MCA_orte_create_session_dirs", "false"},
                                                             {"OMPI_MCA_pml", "ob1"},
                                                             {"OMPI_MCA_btl", "self"}}};
  const bool launched =
      std::any_of(launchers.begin(), launchers.end(), [](const char* name) { return std::getenv(name); });
  std::vector<const char*> mine;
  for (const auto& [name, value] : alone) {
    if (launched || std::getenv(name)) continue;
    setenv(name, value, 0);
    mine.push_back(name);
  }
  MPI_Init(nullptr, nullptr);
  explain_crashes();  // after MPI, whose own handlers print addresses
  for (const char* name : mine) unsetenv(name);
}

}  // namespace

std::string agree_on_exception() {
  const Failure failure = current_failure();
  int size = 1, rank = 0;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (size == 1) return failure.message;
  if (all_ranks_come()) return distinct_texts(Communicator(failures), failure.message);
  fmt::print(stderr, "{}\n(on rank {} of {} only: all are stopped)\n", as_error(failure.message), rank, size);
  std::fflush(nullptr);
  MPI_Abort(MPI_COMM_WORLD, failure.code);
  std::abort();  // not reached
}

int run_on_all_ranks(const std::function<int(bool)>& action) {
  use_one_blas_thread();
  start_mpi();
  MPI_Comm_dup(MPI_COMM_WORLD, &failures);
  const bool is_root = Communicator().rank() == 0;
  int code = ok;
  try {
    code = action(is_root);
  } catch (...) {
    code = current_failure().code;
    const std::string message = agree_on_exception();
    if (is_root) fmt::print(stderr, "{}\n", as_error(message));
  }
  MPI_Comm_free(&failures);
  MPI_Finalize();
  return code;
}

}  // namespace seam::cli
