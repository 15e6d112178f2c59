// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <cmath>
#include <limits>
#include <vector>

namespace limpid::detail {

/// Search for P > 0 with M(x, y)' P M(x, y) < r^2 P at all points of the unit square.
///
/// In coordinates in which P = I serves the middle of the square, an ellipsoid of symmetric matrices is cut through its
/// centre wherever a point shows that centre to be wrong: by a v that must have v' (r^2 P - M' P M) v > 0 or v' P v >
/// 0, both linear in P, and has not. Points are added as they are found to be violated.
template <Real Scalar>
class CommonQuadraticSearch {
 public:
  static constexpr int most = 6, most_entries = most * (most + 1) / 2;  // rows of M, entries of P
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic, 0, most, most>;
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1, 0, most, 1>;
  using Entries = Eigen::Matrix<Scalar, Eigen::Dynamic, 1, 0, most_entries, 1>;
  using Ellipsoid = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic, 0, most_entries, most_entries>;

  template <typename Monodromy>
  CommonQuadraticSearch(const Monodromy& monodromy, const Scalar& r) {
    const Scalar half = Scalar{1} / Scalar{2};
    const Matrix M = monodromy(half, half) / r;
    if (!set_coordinates(M)) return;
    for (int i = 0; i <= along; ++i) {
      for (int j = 0; j <= across; ++j) {
        const Matrix at = monodromy(Scalar(i) / Scalar(along), Scalar(j) / Scalar(across)) / r;
        all_.push_back(V_ * at * W_);
      }
    }
    usable_ = true;
    for (const Matrix& at : all_) usable_ = usable_ && is_finite(at);
  }

  /// Whether one was found.
  [[nodiscard]] bool run() {
    using std::sqrt;
    if (!usable_) return false;
    const Eigen::Index N = W_.rows(), dimension = N * (N + 1) / 2;
    const Scalar n(static_cast<int>(dimension));
    Entries p = Entries::Zero(dimension);
    for (Eigen::Index i = 0; i < N; ++i) p[i] = Scalar{1};
    Ellipsoid E = Ellipsoid::Identity(dimension, dimension) * Scalar(static_cast<int>(N * N));
    for (int i = 0; i < most_cuts; ++i) {
      const Matrix P = matrix_of(p, N);
      const Entries cut = violated(P);
      if (cut.size() == 0) return accept(P);
      const Entries Eg = E * cut;
      const Scalar size = sqrt(cut.dot(Eg));
      if (!(size > Scalar{0}) || !is_finite(size)) return false;
      p += Eg / (size * (n + Scalar{1}));
      E = (n * n / (n * n - Scalar{1})) * (E - (Scalar{2} / ((n + Scalar{1}) * size * size)) * Eg * Eg.transpose());
    }
    return false;
  }

  [[nodiscard]] const Matrix& P() const { return P_; }         ///< in the coordinates of M
  [[nodiscard]] const Matrix& W() const { return scaled_W_; }  ///< W' P W = I to rounding

 private:
  static constexpr int along = 24, across = 8, most_cuts = 20'000;

  // z = V x with W = V^-1, V' V = sum (M'^k Q M^k), Q the states' effects on the next position.
  [[nodiscard]] bool set_coordinates(const Matrix& M) {
    const Eigen::Index N = M.rows();
    Matrix G = Matrix::Identity(N, N), power = M;
    const Scalar velocity = M(0, 1), force = N > 2 ? M.row(0).tail(N - 2).cwiseAbs().maxCoeff() : Scalar{0};
    if (velocity != Scalar{0}) G(1, 1) = velocity * velocity;
    if (force > Scalar{0}) G.diagonal().tail(N - 2).setConstant(force * force);
    // Doubling: G_2k = G_k + M'^k G_k M^k.
    for (int doubling = 0; doubling < 30 && is_finite(G); ++doubling) {
      G += Matrix(power.transpose() * G * power);
      power = Matrix(power * power);
    }
    const Eigen::LLT<Matrix> factor(G);
    if (!is_finite(G) || factor.info() != Eigen::Success) return false;
    V_ = factor.matrixU();
    W_ = factor.matrixU().solve(Matrix::Identity(N, N));
    return is_finite(W_);
  }

  [[nodiscard]] static Matrix matrix_of(const Entries& p, Eigen::Index N) {
    Matrix P(N, N);
    Eigen::Index k = N;
    for (Eigen::Index i = 0; i < N; ++i) {
      P(i, i) = p[i];
      for (Eigen::Index j = 0; j < i; ++j, ++k) P(i, j) = P(j, i) = p[k];
    }
    return P;
  }

  // v' X v for the basis of matrix_of.
  static void add_form(const Vector& v, const Scalar& weight, Entries& cut) {
    Eigen::Index k = v.size();
    for (Eigen::Index i = 0; i < v.size(); ++i) {
      cut[i] += weight * v[i] * v[i];
      for (Eigen::Index j = 0; j < i; ++j, ++k) cut[k] += weight * Scalar{2} * v[i] * v[j];
    }
  }

  // Of a symmetric X that is not positive definite a unit vector v with v' X v <= 0, else nothing: where Cholesky's
  // method meets such a pivot, v = (-X_11^-1 x, 1, 0 ...) of the rows before it.
  [[nodiscard]] static Vector not_positive(const Matrix& X) {
    using std::sqrt;
    const Eigen::Index N = X.rows();
    Matrix F = Matrix::Zero(N, N);  // lower triangular, F F' = X
    for (Eigen::Index j = 0; j < N; ++j) {
      for (Eigen::Index i = j; i < N; ++i) {
        Scalar sum = X(i, j);
        for (Eigen::Index k = 0; k < j; ++k) sum -= F(i, k) * F(j, k);
        if (i > j) {
          F(i, j) = sum / F(j, j);
          continue;
        }
        if (sum > Scalar{0}) {
          F(j, j) = sqrt(sum);
          continue;
        }
        Vector v = Vector::Zero(N);
        v[j] = Scalar{1};
        for (Eigen::Index k = j - 1; k >= 0; --k) {
          Scalar below = F(j, k);
          for (Eigen::Index l = k + 1; l < j; ++l) below += F(l, k) * v[l];
          v[k] = -below / F(k, k);
        }
        return v / v.norm();
      }
    }
    return {};
  }

  // Nothing where P serves every point.
  [[nodiscard]] Entries violated(const Matrix& P) {
    const Eigen::Index N = P.rows();
    Entries cut = Entries::Zero(N * (N + 1) / 2);
    if (const Vector v = not_positive(P); v.size() > 0) {
      add_form(v, Scalar{1}, cut);
      return cut;
    }
    for (const auto* points : {&active_, &all_}) {
      Scalar least = std::numeric_limits<Scalar>::infinity();
      const Matrix* worst = nullptr;
      Vector direction;
      for (const Matrix& M : *points) {
        const Matrix X = P - M.transpose() * P * M;
        const Vector v = not_positive(X);
        if (v.size() == 0 || !(v.dot(X * v) < least)) continue;
        least = v.dot(X * v);
        worst = &M;
        direction = v;
      }
      if (!worst) continue;
      add_form(direction, Scalar{1}, cut);
      add_form(*worst * direction, Scalar{-1}, cut);
      if (points == &all_) active_.push_back(*worst);
      return cut;
    }
    return {};
  }

  [[nodiscard]] bool accept(const Matrix& P) {
    const Eigen::LLT<Matrix> factor(P);
    if (factor.info() != Eigen::Success) return false;
    const Matrix raw = V_.transpose() * P * V_;
    P_ = (raw + raw.transpose()) / Scalar{2};
    scaled_W_ = W_ * Matrix(factor.matrixU().solve(Matrix::Identity(P.rows(), P.cols())));
    return true;
  }

  std::vector<Matrix> all_, active_;
  Matrix V_, W_, P_, scaled_W_;
  bool usable_{false};
};

}  // namespace limpid::detail
