// SPDX-License-Identifier: BSD-3-Clause
#include "seam/linear/mumps_solver.hpp"

#include <dmumps_c.h>
#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

#include "seam/base/stopwatch.hpp"
#include "seam/linear/gmres.hpp"

namespace seam {
namespace {

/// Small enough for Newton's method to converge as with exact solutions.
constexpr double kept_tolerance = 1e-7;

/// Below this part of unknowns that kept factors know they are not tried.
constexpr double enough_known = 0.8;

// MUMPS' job codes.
constexpr int job_begin = -1, job_end = -2, job_analyse = 1, job_factorise = 2, job_solve = 3;

}  // namespace

struct MumpsSolver::Instance {
  DMUMPS_STRUC_C mumps{};
  std::vector<int> row, column;
  long long pattern_version = -1;
  bool factorised = false;
  int last_iterations = 0;                      ///< of the last system the factors preconditioned
  std::unordered_map<long long, int> equation;  ///< number of each unknown when it was factorised
  bool begun = false;

  // MUMPS' manual counts its control arrays from 1.
  int& control(int i) { return mumps.icntl[i - 1]; }
  [[nodiscard]] int info(int i) const { return mumps.infog[i - 1]; }

  void run(int job) {
    mumps.job = job;
    dmumps_c(&mumps);
  }
  /// @return the whole solution, on every rank. Right-hand side and solution pass through rank 0: they are
  /// small beside the factors.
  /// @param all the whole right-hand side
  std::vector<double> solve(const Communicator& communicator, std::vector<double> all) {
    mumps.rhs = all.data();
    run(job_solve);
    if (info(1) < 0) throw Error(fmt::format("MUMPS could not solve: error {} ({})", info(1), info(2)));
    MPI_Bcast(all.data(), static_cast<int>(all.size()), MPI_DOUBLE, 0, communicator.handle());
    return all;
  }
  ~Instance() {
    int finalised = 0;
    MPI_Finalized(&finalised);
    if (begun && !finalised) run(job_end);
  }
};

/// The inverse of a matrix factorised earlier as a preconditioner of a later one. Unknowns that have come
/// alive since are scaled by their diagonal; those that are gone have a right-hand side of zero.
class MumpsSolver::KeptFactors final : public TpetraOperator {
 public:
  KeptFactors(std::shared_ptr<Instance> instance, const Matrix& a, Teuchos::RCP<const TpetraMap> map)
      : instance_(std::move(instance)), map_(std::move(map)), communicator_(a.communicator) {
    same_unknowns_ = instance_->pattern_version == a.pattern_version;
    if (same_unknowns_) return;
    place_.assign(a.rows, -1);
    inverse_diagonal_.assign(a.rows, 0.0);
    for (int r = 0; r < a.rows; ++r) {
      const auto found = instance_->equation.find(a.unknown[r]);
      if (found != instance_->equation.end()) place_[r] = found->second;
      for (std::size_t k = a.row_start[r]; k < a.row_start[r + 1]; ++k)
        if (a.column[k] == r && a.value[k] != 0) inverse_diagonal_[r] = 1 / a.value[k];
    }
  }
  /// Part of the unknowns that the factors know. Collective.
  [[nodiscard]] double known() const {
    if (same_unknowns_) return 1;
    const auto count = std::count_if(place_.begin(), place_.end(), [](int p) { return p >= 0; });
    return static_cast<double>(communicator_.sum(static_cast<long long>(count))) /
           static_cast<double>(communicator_.sum(static_cast<long long>(place_.size())));
  }
  [[nodiscard]] Teuchos::RCP<const TpetraMap> getDomainMap() const override { return map_; }
  [[nodiscard]] Teuchos::RCP<const TpetraMap> getRangeMap() const override { return map_; }
  void apply(const TpetraVector& x, TpetraVector& y, Teuchos::ETransp, double, double) const override {
    std::vector<double> in;
    from_tpetra(x, in);
    auto out = y.getDataNonConst(0);
    if (same_unknowns_) {
      const std::vector<double> all = instance_->solve(communicator_, communicator_.gather_all(in));
      std::copy_n(all.begin() + map_->getMinGlobalIndex(), in.size(), out.begin());
      return;
    }
    std::vector<double> right(instance_->equation.size(), 0.0);
    for (std::size_t r = 0; r < in.size(); ++r)
      if (place_[r] >= 0) right[place_[r]] = in[r];
    communicator_.sum(right);
    const std::vector<double> all = instance_->solve(communicator_, std::move(right));
    for (std::size_t r = 0; r < in.size(); ++r)
      out[static_cast<int>(r)] = place_[r] >= 0 ? all[place_[r]] : inverse_diagonal_[r] * in[r];
  }

 private:
  std::shared_ptr<Instance> instance_;
  Teuchos::RCP<const TpetraMap> map_;
  Communicator communicator_;
  bool same_unknowns_ = true;
  std::vector<int> place_;  ///< [row]: equation of its unknown when the matrix was factorised, -1: none
  std::vector<double> inverse_diagonal_;
};

MumpsSolver::MumpsSolver() : instance_(std::make_shared<Instance>()) {}
MumpsSolver::MumpsSolver(const Parameters& p) : MumpsSolver() { keep_ = static_cast<int>(p.integer("keep")); }
MumpsSolver::~MumpsSolver() = default;

Schema MumpsSolver::schema() {
  Schema s("Distributed sparse direct factorisation (MUMPS): robust, for up to some 10^5 unknowns in 3D.");
  s.integer(
       "keep",
       "A factorisation is kept as preconditioner of later systems, also over moving cuts, while they take "
       "at most so many iterations; 0: each system is factorised")
      .otherwise("0")
      .at_least(0);
  return s;
}

void MumpsSolver::analyse(const Matrix& a) {
  Instance& m = *instance_;
  if (!m.begun) {
    m.mumps.par = 1;
    m.mumps.sym = 0;
    m.mumps.comm_fortran = static_cast<MUMPS_INT>(MPI_Comm_c2f(a.communicator.handle()));
    m.run(job_begin);
    m.begun = true;
    for (const int stream : {1, 2, 3}) m.control(stream) = -1;  // silent
    m.control(4) = 0;
    m.control(18) = 3;   // distributed entries
    m.control(14) = 40;  // % more memory than estimated: pivoting on saddle points needs it
    m.control(24) = 1;   // detect null pivots, so that they can be named
  }
  m.row.resize(a.entries());
  m.column.resize(a.entries());
  for (int r = 0; r < a.rows; ++r)
    for (std::size_t k = a.row_start[r]; k < a.row_start[r + 1]; ++k) {
      m.row[k] = static_cast<int>(a.first_row + r + 1);
      m.column[k] = static_cast<int>(a.column_global[a.column[k]] + 1);
    }
  m.mumps.n = static_cast<int>(a.global_rows);
  m.mumps.nnz_loc = static_cast<MUMPS_INT8>(a.entries());
  m.mumps.irn_loc = m.row.data();
  m.mumps.jcn_loc = m.column.data();
  m.mumps.a_loc = const_cast<double*>(a.value.data);
  m.run(job_analyse);
  if (m.info(1) < 0)
    throw Error(fmt::format("MUMPS could not analyse the matrix of {} unknowns: error {} ({})", a.global_rows,
                            m.info(1), m.info(2)));
  m.pattern_version = a.pattern_version;
}

void MumpsSolver::factorise(const Matrix& a) {
  Instance& m = *instance_;
  m.mumps.a_loc = const_cast<double*>(a.value.data);
  m.run(job_factorise);
  // -8, -9: the work space was too small for the pivoting that turned out to be needed.
  for (int attempt = 0; attempt < 4 && (m.info(1) == -8 || m.info(1) == -9); ++attempt) {
    m.control(14) *= 2;
    m.run(job_factorise);
  }
  if (m.info(1) == -10) throw SingularMatrix("the matrix is numerically singular", {});
  if (m.info(1) == -13)
    throw Error(
        fmt::format("MUMPS ran out of memory factorising {} unknowns: use `linear: krylov`", a.global_rows));
  if (m.info(1) < 0)
    throw Error(fmt::format("MUMPS could not factorise the matrix of {} unknowns: error {} ({})",
                            a.global_rows, m.info(1), m.info(2)));
  int null_pivots = m.info(28);
  if (null_pivots > 0) {
    std::vector<long long> equations;
    if (a.communicator.rank() == 0)
      for (int k = 0; k < std::min(null_pivots, 20); ++k) equations.push_back(m.mumps.pivnul_list[k] - 1);
    equations = a.communicator.gather_all(equations);
    throw SingularMatrix(fmt::format("the matrix is singular: {} null pivots", null_pivots), equations);
  }
}

void MumpsSolver::solve_into(const Matrix& a, const std::vector<EquationBlock>&, const std::vector<double>& b,
                             std::vector<double>& x, SolveReport& report) {
  if (a.global_rows >= 2147483647LL)
    throw Error("the direct solver is limited to 2^31 unknowns: use `linear: krylov`");
  if (worth_keeping() && solve_with_kept(a, b, x, report)) return;
  const Stopwatch watch;
  if (instance_->pattern_version != a.pattern_version) analyse(a);
  instance_->factorised = false;
  factorise(a);
  instance_->factorised = true;
  if (keep_ > 0) remember_unknowns(a);
  instance_->last_iterations = 0;
  report.new_factorisation = true;
  report.setup_seconds = watch.seconds();
  const std::vector<double> all = instance_->solve(a.communicator, a.communicator.gather_all(b));
  std::copy_n(all.begin() + a.first_row, a.rows, x.begin());
  refine(a, b, x);
}

/// Where rows and columns are of very different sizes, as those of a body of a hundredth of a millimetre in
/// SI units, the first solution may leave more than it ought to; what it leaves is solved for again.
void MumpsSolver::refine(const Matrix& a, const std::vector<double>& b, std::vector<double>& x) {
  constexpr int most = 3;
  std::vector<double> left;
  for (int k = 0; k < most; ++k) {
    multiply(a, x, left);
    double square = 0, whole = 0;
    for (int i = 0; i < a.rows; ++i) {
      left[i] = b[i] - left[i];
      square += std::pow(weights()[i] * left[i], 2);
      whole += std::pow(weights()[i] * b[i], 2);
    }
    if (!(a.communicator.sum(square) > std::pow(acceptable_residual_, 2) * a.communicator.sum(whole))) return;
    const std::vector<double> all = instance_->solve(a.communicator, a.communicator.gather_all(left));
    for (int i = 0; i < a.rows; ++i) x[i] += all[a.first_row + i];
  }
}

std::optional<LinearSolver::Effort> MumpsSolver::effort(const Matrix& a) {
  if (a.global_rows == 0) return Effort{};
  if (instance_->pattern_version != a.pattern_version) analyse(a);
  return Effort{1e6 * instance_->info(17), instance_->mumps.rinfog[0]};
}

void MumpsSolver::forget() { instance_->factorised = false; }

void MumpsSolver::remember_unknowns(const Matrix& a) {
  const std::vector<long long> all = a.communicator.gather_all(a.unknown);
  instance_->equation.clear();
  instance_->equation.reserve(all.size());
  for (std::size_t e = 0; e < all.size(); ++e) instance_->equation.emplace(all[e], static_cast<int>(e));
}

bool MumpsSolver::worth_keeping() const {
  return keep_ > 0 && instance_->factorised && instance_->last_iterations <= keep_;
}

/// @return false when it took too many iterations: then the factors are too old
bool MumpsSolver::solve_with_kept(const Matrix& a, const std::vector<double>& b, std::vector<double>& x,
                                  SolveReport& report) {
  const auto matrix = tpetra_view(a);
  const auto factors = Teuchos::rcp(new KeptFactors(instance_, a, matrix->getDomainMap()));
  if (factors->known() < enough_known) return false;
  // Half as many again as are worth it: to finish is cheaper then than to begin anew.
  const GmresOptions options{kept_tolerance, 3 * keep_ / 2 + 1, 3 * keep_ / 2 + 1};
  report.iterations = gmres(matrix, factors, weights(), b, x, options);
  report.new_factorisation = false;
  instance_->last_iterations = report.iterations;
  if (report.iterations < options.maximum_iterations) return true;
  std::fill(x.begin(), x.end(), 0.0);
  return false;
}

}  // namespace seam
