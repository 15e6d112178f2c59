// SPDX-License-Identifier: MIT
// As design_instances.hpp, for Eigen's eigenvalues of matrices of any size in double.
#pragma once

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

namespace Eigen {

extern template EigenSolver<MatrixXd>& EigenSolver<MatrixXd>::compute(const EigenBase<MatrixXd>&, bool);
extern template SelfAdjointEigenSolver<MatrixXd>& SelfAdjointEigenSolver<MatrixXd>::compute(const EigenBase<MatrixXd>&,
                                                                                            int);

}  // namespace Eigen
