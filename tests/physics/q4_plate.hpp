// A plate of square four-node elements, to hold a run against: static, linear elastic, plane strain, 2 x 2 Gauss points
// (T.J.R. Hughes, The Finite Element Method, section 4). Nodes may be doubled along a row, which makes a crack.
#pragma once
#include <Eigen/Sparse>
#include <array>
#include <cmath>
#include <vector>

#include "core/math/vec.hpp"
#include "core/scene/scene.hpp"

namespace riven::test {

class Q4Plate {
 public:
  /// `nx` x `ny` elements of edge `h` from `lower`. The nodes (i, split_row), i >= split_from, are doubled.
  Q4Plate(Vec2 lower, int nx, int ny, double h, const Material& material, double thickness, int split_row,
          int split_from)
      : lower_(lower), nx_(nx), ny_(ny), h_(h), t_(thickness), split_row_(split_row), split_from_(split_from) {
    const double E = material.E, nu = material.nu, s = E / ((1 + nu) * (1 - 2 * nu));
    D_ << s * (1 - nu), s * nu, 0, s * nu, s * (1 - nu), 0, 0, 0, s * (1 - 2 * nu) / 2;
    const int nodes = (nx + 1) * (ny + 1) + nx + 1 - split_from;
    force_ = u_ = Eigen::VectorXd::Zero(2 * nodes);
    fixed_.assign(static_cast<size_t>(2 * nodes), false);
  }

  void fix(int i, int j, int axis) { fixed_[static_cast<size_t>(2 * node(i, j) + axis)] = true; }

  /// A force at a point, shared by the nodes of its element.
  void push(Vec2 at, Vec2 force) {
    const Place p = place(at);
    for (int a = 0; a < 4; ++a) {
      const double N = 0.25 * (1 + corner[a].x * p.local.x) * (1 + corner[a].y * p.local.y);
      force_[2 * p.nodes[a]] += N * force.x;
      force_[2 * p.nodes[a] + 1] += N * force.y;
    }
  }

  void solve() {
    Eigen::Matrix<double, 8, 8> Ke = Eigen::Matrix<double, 8, 8>::Zero();
    const double g = 1 / std::sqrt(3.);
    for (const double x : {-g, g})
      for (const double y : {-g, g}) {
        const Strains B = strains({x, y});
        Ke += B.transpose() * D_ * B * (0.25 * h_ * h_ * t_);
      }
    std::vector<Eigen::Triplet<double>> entries;
    for (int j = 0; j < ny_; ++j)
      for (int i = 0; i < nx_; ++i) {
        const std::array<int, 8> at = freedoms(nodes_of(i, j));
        for (int r = 0; r < 8; ++r)
          for (int c = 0; c < 8; ++c)
            if (!is_fixed(at[r]) && !is_fixed(at[c]))
              entries.emplace_back(at[r], at[c], Ke(r, c));
      }
    for (int k = 0; k < u_.size(); ++k)
      if (is_fixed(k)) {
        entries.emplace_back(k, k, 1);
        force_[k] = 0;
      }
    Eigen::SparseMatrix<double> K(u_.size(), u_.size());
    K.setFromTriplets(entries.begin(), entries.end());
    u_ = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(K).solve(force_);
  }

  Vec2 displacement(Vec2 at) const {
    const Place p = place(at);
    Vec2 u;
    for (int a = 0; a < 4; ++a) {
      const double N = 0.25 * (1 + corner[a].x * p.local.x) * (1 + corner[a].y * p.local.y);
      u += N * Vec2{u_[2 * p.nodes[a]], u_[2 * p.nodes[a] + 1]};
    }
    return u;
  }
  /// sxx, syy, sxy in Pa.
  Eigen::Vector3d stress(Vec2 at) const {
    const Place p = place(at);
    Eigen::Matrix<double, 8, 1> u;
    const std::array<int, 8> f = freedoms(p.nodes);
    for (int k = 0; k < 8; ++k)
      u[k] = u_[f[k]];
    return D_ * strains(p.local) * u;
  }
  double strain_energy() const { return 0.5 * u_.dot(force_); }

 private:
  using Nodes = std::array<int, 4>;
  using Strains = Eigen::Matrix<double, 3, 8>;
  struct Place {
    Nodes nodes;
    Vec2 local;  ///< from -1 to 1
  };
  static constexpr Vec2 corner[4] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};

  bool is_fixed(int freedom) const { return fixed_[static_cast<size_t>(freedom)]; }
  /// The lower one of a doubled pair.
  int node(int i, int j) const { return j * (nx_ + 1) + i; }
  /// The node as the elements above the split see it.
  int node_from_above(int i, int j) const {
    return j == split_row_ && i >= split_from_ ? (nx_ + 1) * (ny_ + 1) + i - split_from_ : node(i, j);
  }
  Nodes nodes_of(int i, int j) const {
    return {node_from_above(i, j), node_from_above(i + 1, j), node(i + 1, j + 1), node(i, j + 1)};
  }
  static std::array<int, 8> freedoms(const Nodes& n) {
    return {2 * n[0], 2 * n[0] + 1, 2 * n[1], 2 * n[1] + 1, 2 * n[2], 2 * n[2] + 1, 2 * n[3], 2 * n[3] + 1};
  }
  Place place(Vec2 at) const {
    const Vec2 X = (at - lower_) * (1 / h_);
    const int i = static_cast<int>(X.x), j = static_cast<int>(X.y);
    return {nodes_of(i, j), {2 * (X.x - i) - 1, 2 * (X.y - j) - 1}};
  }
  Strains strains(Vec2 p) const {
    Strains B = Strains::Zero();
    for (int a = 0; a < 4; ++a) {
      const double dx = corner[a].x * (1 + corner[a].y * p.y) / (2 * h_);
      const double dy = corner[a].y * (1 + corner[a].x * p.x) / (2 * h_);
      B(0, 2 * a) = B(2, 2 * a + 1) = dx;
      B(1, 2 * a + 1) = B(2, 2 * a) = dy;
    }
    return B;
  }

  Vec2 lower_;
  int nx_, ny_;
  double h_, t_;
  int split_row_, split_from_;
  Eigen::Matrix3d D_;
  Eigen::VectorXd force_, u_;
  std::vector<bool> fixed_;
};

}  // namespace riven::test
