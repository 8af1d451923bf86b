// SPDX-License-Identifier: BSD-3-Clause
// Vectors of all kinds are configurations as they are, and what is none does not compile.
#include "swept/robot_model/configuration.hpp"

#include <gtest/gtest.h>

#include <array>
#include <list>
#include <string>
#include <type_traits>
#include <vector>

#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/inverse_kinematics.hpp"
#include "swept/robot_model/named_states.hpp"

namespace swept {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector2d;
using Eigen::VectorXd;
using Strided = Eigen::Map<const VectorXd, 0, Eigen::InnerStride<2>>;
using Head = decltype(VectorXd().head(2));
using ConstHead = decltype(std::declval<const VectorXd&>().head(2));
using Column = decltype(Eigen::MatrixXd().col(0));
using Row = decltype(Eigen::MatrixXd().row(0));
using Sum = decltype(VectorXd() + VectorXd());

template <typename Values>
concept Read = std::is_convertible_v<Values, ConfigurationView> &&
    requires(const Checker& checker, Workspace& workspace, Values&& values) {
  checker.checkState(static_cast<Values&&>(values), workspace);
  checker.interpolate(static_cast<Values&&>(values), static_cast<Values&&>(values), 0.5);
};
template <typename Values>
concept Written = std::is_convertible_v<Values, ConfigurationSpan>;

static_assert(Read<std::vector<double>> && Read<std::vector<double>&>);
static_assert(Read<const std::vector<double>&> && Read<std::array<double, 2>>);
static_assert(Read<const double (&)[2]> && Read<std::initializer_list<double>>);
static_assert(Read<std::span<double>> && Read<std::span<const double>>);
static_assert(Read<std::span<const double, 2>> && Read<ConfigurationSpan>);
static_assert(Read<VectorXd> && Read<VectorXd&> && Read<const VectorXd&> && Read<Vector2d>);
static_assert(Read<Eigen::RowVectorXd> && Read<Eigen::ArrayXd>);
static_assert(Read<Eigen::Map<VectorXd>> && Read<Eigen::Map<const VectorXd>>);
static_assert(Read<Eigen::Ref<const VectorXd>> && Read<Head> && Read<ConstHead> && Read<Column>);

static_assert(!Read<Eigen::VectorXf> && !Read<std::vector<float>> && !Read<std::vector<int>>);
static_assert(!Read<std::list<double>> && !Read<std::string> && !Read<double> && !Read<int>);
static_assert(!Read<Sum> && !Read<Row> && !Read<Strided> && !Read<Eigen::MatrixXd>);
static_assert(!Read<decltype(VectorXd::Zero(2))>);

static_assert(Written<std::vector<double>&> && Written<std::array<double, 2>&>);
static_assert(Written<VectorXd&> && Written<Vector2d&> && Written<Eigen::Map<VectorXd>>);
static_assert(Written<Eigen::Ref<VectorXd>> && Written<Head> && Written<Column>);
static_assert(Written<std::span<double>>);
// What nobody can read afterwards, or may not change.
static_assert(!Written<VectorXd> && !Written<std::vector<double>> && !Written<Vector2d>);
static_assert(!Written<const VectorXd&> && !Written<const std::vector<double>&>);
static_assert(!Written<std::span<const double>> && !Written<ConfigurationView>);
static_assert(!Written<Eigen::VectorXf&> && !Written<Row> && !Written<ConstHead>);

template <typename Values>
concept Packed = std::is_convertible_v<Values, PackedConfigurations>;
static_assert(Packed<std::vector<double>> && Packed<VectorXd> && Packed<Eigen::MatrixXd>);
static_assert(Packed<Eigen::Matrix<double, 2, Eigen::Dynamic>&> && Packed<Eigen::Matrix2d>);
static_assert(!Packed<Eigen::Matrix<double, 2, 2, Eigen::RowMajor>> && !Packed<Eigen::MatrixXf>);
static_assert(!Packed<decltype(Eigen::MatrixXd().topRows(1))> && !Packed<std::vector<VectorXd>>);

template <typename Values>
concept Listed = std::is_convertible_v<Values, ConfigurationList>;
static_assert(Listed<std::vector<std::vector<double>>> && Listed<std::vector<VectorXd>&>);
static_assert(Listed<std::list<Vector2d>> && Listed<std::array<std::array<double, 2>, 3>>);
static_assert(Listed<std::vector<std::span<const double>>> &&
              Listed<std::vector<ConfigurationView>>);
static_assert(!Listed<std::vector<std::vector<float>>> && !Listed<std::vector<double>>);

// It is passed as a span is: in two registers.
static_assert(std::is_trivially_copyable_v<ConfigurationView>);
static_assert(sizeof(ConfigurationView) == sizeof(std::span<const double>));

constexpr const char* kUrdf = R"(<robot name='crane'>
  <link name='base'/>
  <link name='trolley'><collision><geometry><sphere radius='0.1'/></geometry></collision></link>
  <link name='hook'><collision><geometry><sphere radius='0.1'/></geometry></collision></link>
  <joint name='along' type='prismatic'><parent link='base'/><child link='trolley'/>
    <axis xyz='1 0 0'/><limit lower='-2' upper='2' effort='1' velocity='1'/></joint>
  <joint name='down' type='prismatic'><parent link='trolley'/><child link='hook'/>
    <axis xyz='0 0 -1'/><limit lower='0' upper='2' effort='1' velocity='1'/></joint>
</robot>)";

class Configurations : public testing::Test {
 protected:
  Configurations() : checker_(Robot::parse(kUrdf, "crane.urdf"), "all", world()) {}
  static std::shared_ptr<const World> world() {
    auto world = std::make_shared<World>();
    world->add("floor", makeBox({4, 4, 0.2}), Isometry3d(Eigen::Translation3d(0, 0, -1.1)));
    return world;
  }
  /// m, from the hook to the floor.
  double gap(ConfigurationView q) { return checker_.clearance(q, workspace_); }

  Checker checker_;
  Workspace workspace_{checker_};
};

TEST_F(Configurations, OfAnyKindGetTheSameAnswer) {
  const std::vector<double> vector{0.4, 0.7};
  const std::array<double, 2> array{0.4, 0.7};
  const double plain[] = {0.4, 0.7};
  const VectorXd eigen{{0.4, 0.7}};
  const Vector2d fixed(0.4, 0.7);
  Eigen::MatrixXd matrix(2, 3);
  matrix << 9, 0.4, 9, 9, 0.7, 9;
  const VectorXd longer{{0.4, 0.7, 9}};
  const double wanted = gap(vector);
  EXPECT_NEAR(wanted, 1.0 - 0.7 - 0.1, 1e-9);
  EXPECT_EQ(gap(array), wanted);
  EXPECT_EQ(gap(plain), wanted);
  EXPECT_EQ(gap(eigen), wanted);
  EXPECT_EQ(gap(fixed), wanted);
  EXPECT_EQ(gap(matrix.col(1)), wanted);
  EXPECT_EQ(gap(longer.head(2)), wanted);
  EXPECT_EQ(gap(Eigen::Map<const VectorXd>(plain, 2)), wanted);
  EXPECT_EQ(gap({0.4, 0.7}), wanted);
  EXPECT_EQ(gap({longer.data(), 2}), wanted);
  EXPECT_EQ(gap((0.5 * (eigen + fixed)).eval()), wanted);
}

TEST_F(Configurations, OfTheWrongSizeAreRefused) {
  EXPECT_THROW(gap(Eigen::Vector3d::Zero().eval()), std::invalid_argument);
  EXPECT_THROW(gap({0.4}), std::invalid_argument);
  EXPECT_THROW(gap({}), std::invalid_argument);
}

// What each function returns goes into each other.
TEST_F(Configurations, ResultsAreArguments) {
  const Robot& robot = checker_.robot();
  const auto named = namedConfiguration(robot, checker_.group(), "default");
  const auto whole = robot.defaultState();
  const auto between = checker_.interpolate(named, {1.0, 1.5}, 0.5);
  EXPECT_EQ(checker_.checkState(between, workspace_), Verdict::Free);
  EXPECT_EQ(checker_.certifyMotion(whole, between, workspace_).verdict, Verdict::Free);
  EXPECT_EQ(checker_.certifyMotion(between, {1.0, 0.95}, workspace_).verdict, Verdict::Collision);
  EXPECT_EQ(makeNamedState(checker_.group(), "there", between).values[1].second, between[1]);

  VectorXd into(2), gradient(2), solution = whole;
  checker_.interpolate(named, between, 1.0, into);
  EXPECT_EQ(into, between);
  checker_.signedClearance(between, workspace_, gradient);
  EXPECT_TRUE(gradient.isApprox(Vector2d(0, -1)));
  const InverseKinematics kinematics(Robot::parse(kUrdf, "crane.urdf"), "all", "hook");
  InverseKinematics::Workspace scratch(kinematics);
  EXPECT_TRUE(kinematics.solve(kinematics.pose(between), solution, {}, scratch));
  EXPECT_TRUE(solution.isApprox(between, 1e-5));
}

TEST_F(Configurations, ColumnsOfAMatrixAreABatch) {
  Eigen::MatrixXd from(2, 3);
  from << 0, 0.5, 1, 0.5, 0.95, 1.05;
  const Eigen::MatrixXd to = from.array() + 0.01;
  std::array<Verdict, 3> states;
  checker_.checkStates(from, states);
  EXPECT_EQ(states, (std::array{Verdict::Free, Verdict::Collision, Verdict::Collision}));
  std::array<MotionCertificate, 3> motions;
  checker_.certifyMotions(from, to, motions);
  for (int i = 0; i < 3; ++i)
    EXPECT_EQ(motions[i].verdict,
              checker_.certifyMotion(from.col(i), to.col(i), workspace_).verdict);
}

}  // namespace
}  // namespace swept
