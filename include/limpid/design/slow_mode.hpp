// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/design/reduced_lmi.hpp>

/// A proof for the case that the best margin with L free is exactly zero, as with over-damped tissues and a long delay.
///
/// Let w' A = s w' with s real. W = diag(w, w, w) takes the 6 x 6 block for a free gain to 3 x 3 in the scalars
/// p = w'P w, q, r > 0, x = w'X'w and y = w'B Y w:
///
///     Xi0(p, q, r) + He([1; a2; a3] [-s x  -y  x]) < 0
///
/// the LMI of the mode e' = s e + l e_d alone. Without a solution of this one there is none of the other, whose
/// multipliers are then of the form z (x) w w' and singular: no Z > 0 can be found in 6 x 6. In 3 x 3 it is z > 0 with
///
///     y: (z e)_2 = 0,   x: (z e)_3 = s (z e)_1,   e = (1, a2, a3)
///     p, q, r: z_31, z_11 - z_22 and T z_33 - (z_11 - 2 z_21 + z_22)/T are positive
namespace limpid::detail {

/// Whether z, once z_21 and z_32 are set so that both equations hold, proves it for the mode s.
template <Real Scalar>
[[nodiscard]] bool mode_multiplier_proves(const Square<Scalar, 3>& z, const Ball<Scalar>& s,
                                          const ScaledDesign<Ball<Scalar>>& design) {
  using B = Ball<Scalar>;
  const B &a2 = design.a2, &a3 = design.a3;
  const B z11(z(0, 0)), z22(z(1, 1)), z33(z(2, 2)), z31(z(2, 0));
  const B z32 = (s * (z11 + a3 * z31) - z31 - a3 * z33 - s * a2 * a2 * z22) / (a2 + s * a2 * a3);
  const B z21 = -(a2 * z22 + a3 * z32);
  const Square<B, 3> Z{{z11, z21, z31, z21, z22, z32, z31, z32, z33}};
  const B left = design.T * z33 - (z11 - z21 - z21 + z22) / design.T;
  return z31.certainly_positive() && (z11 - z22).certainly_positive() && left.certainly_positive() &&
         proves_positive(Z);
}

/// Whether one of A's real modes has no solution; z is taken from a solver's last Z of the 6 x 6 block.
///
/// A = [0 1; A_21 A_22] has the right eigenvector v = (1, s), and Z close to z (x) w w' gives z_ij = v' Z_ij v.
template <Real Scalar>
[[nodiscard]] bool mode_proves_infeasible(const Square<Scalar, 6>& Z, const Matrix2<Ball<Scalar>>& A,
                                          const ScaledDesign<Ball<Scalar>>& design) {
  using B = Ball<Scalar>;
  const B discriminant = A.a22 * A.a22 + B(Scalar{4}) * A.a21;
  if (!discriminant.certainly_positive()) return false;
  const B root = sqrt(discriminant), larger = (A.a22.centre() < Scalar{0} ? A.a22 - root : A.a22 + root);
  const B fast = larger * B(Scalar{1} / Scalar{2});
  for (const B& s : {-A.a21 / fast, fast}) {
    const Scalar v2 = s.centre();
    Square<Scalar, 3> z;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        const Matrix2<Scalar> block = get_block(Z, 2 * i, 2 * j);
        z(i, j) = block.a11 + (block.a12 + block.a21) * v2 + block.a22 * v2 * v2;
      }
    }
    if (mode_multiplier_proves(z, s, design)) return true;
  }
  return false;
}

}  // namespace limpid::detail
