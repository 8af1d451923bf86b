// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "swept/core/tolerances.hpp"

namespace swept {

struct Command;

/// Options of `bench planners` and `bench summary` alone.
struct BatchArguments {
  std::vector<std::string> planners = {"RRTConnect"};
  std::vector<std::string> validators = {"certified"};
  int runs = 1;                     ///< of each planner and validator on each problem
  std::optional<double> hardLimit;  ///< s
  std::string log;                  ///< folder
  std::string csv;
  bool list = false;
  bool fromStdin = false;
  bool noTimes = false;
  bool noClearance = false;
  bool states = false;
  std::vector<std::string> files;  ///< results of earlier batches
};

/// The command line, as typed. Each subcommand reads the part it has.
struct Arguments {
  const Command* command = nullptr;
  std::string robot;                        ///< URDF file, or a work cell (.yaml)
  bool xacro = false;                       ///< `robot` is what the program xacro makes of it
  std::vector<std::string> xacroArguments;  ///< NAME:=VALUE
  std::vector<std::string> states;  ///< names, comma-separated values, @FILE, - or a path file
  bool degrees = false;             ///< angles of values in `states`
  std::string path;                 ///< path file of certify

  /// The clock of objects of the scene that move.
  struct Clock {
    std::optional<double> time;   ///< s, of all states of check
    std::string times;            ///< s, T,T,...: of the states of motion
    std::optional<double> begin;  ///< s, at the time 0 of a trajectory
  } clock;

  std::string srdf;  ///< empty: a file beside the URDF; `none`: without
  std::string scene;
  std::vector<std::string> clouds;    ///< files
  std::optional<double> pointRadius;  ///< m
  std::string cloudPose;              ///< world_from_cloud: x,y,z,qx,qy,qz,qw
  std::optional<double> selfFilter;   ///< m
  std::optional<double> occluded;     ///< m
  std::string group;
  std::string joints;                  ///< A,B,...: the group is of these
  std::string chain;                   ///< BASE,TIP: the group is of the joints between
  bool keepDefaultContacts = false;    ///< of a robot without an SRDF
  std::vector<std::string> packages;   ///< NAME=DIR
  std::vector<std::string> pads;       ///< NAME=METRES
  std::vector<std::string> scales;     ///< NAME=FACTOR
  std::vector<std::string> allowed;    ///< A,B
  std::vector<std::string> attached;   ///< SHAPE@LINK[:POSE]
  std::vector<std::string> standing;   ///< GROUP=STATE
  std::vector<std::string> explained;  ///< A,B
  double margin = 0.0;                 ///< m
  ///@{
  /// m. The margins of pairs of two links or attached bodies, and of pairs with the world, in place
  /// of `margin`.
  std::optional<double> selfMargin, worldMargin;
  ///@}
  double tolerance = tolerance::kMotion;  ///< m
  bool json = false;
  bool quiet = false;
  bool verbose = false;  ///< each warning, and the planners' messages

  std::string problems;  ///< JSON file
  std::string set;
  std::optional<int> index;

  std::vector<std::string> cases;  ///< JSON files of replay
  std::string dump;                ///< folder for queries that are not free
  std::string shell;               ///< of completion; `words`: no script, but what may follow
  std::string line;                ///< what is typed so far, for it

  std::string edges;  ///< CSV file of bench edges
  int passes = 5;
  std::optional<int> limit;
  std::string against;  ///< `fcl`, or empty

  BatchArguments batch;

  std::string planner = "CertifiedConnect";
  double time = 5.0;            ///< s
  std::optional<double> range;  ///< of the planner's motions, in the metric of the state space
  std::uint32_t seed = 1;
  std::string output;
  bool noSimplify = false;
  std::optional<double> simplifyTime;  ///< s, of OMPL's simplifier; none: shortenPath()
  int threads = 1;
  std::string request;                         ///< YAML file
  std::string goalPose;                        ///< model_from_link: x,y,z,qx,qy,qz,qw
  std::string goalLink;                        ///< empty: the group's tip
  std::optional<double> positionTolerance;     ///< m, of goalPose
  std::optional<double> orientationTolerance;  ///< rad, of goalPose
  int jobs = 1;

  bool embed = false;  ///< robot and world go into the path file

  struct Verify {
    std::string path;   ///< JSON file
    std::string robot;  ///< instead of the one that the path file names; empty: that one
    std::string scene;  ///< likewise
    bool files = false;
  } verify;

  std::string tracking;     ///< E or JOINT=E,...; empty: no joint is off
  std::string controllers;  ///< parameters of ros2_control; empty: none

  std::vector<std::string> keepUpright;  ///< LINK[:DEG[:AXIS]]
  std::vector<std::string> keepLevel;    ///< LINK[:DEG]
  std::vector<std::string> stayIn;       ///< LINK:SHAPE[@POSE]
  std::vector<std::string> stayOn;       ///< LINK:line|plane:X,Y,Z,DX,DY,DZ[:M]

  std::string limits;  ///< joint_limits.yaml; empty: the URDF's velocities

  /// How a path becomes a trajectory.
  struct Timing {
    bool timed = false;                     ///< whether that of plan does
    std::optional<double> maxAcceleration;  ///< rad/s^2 or m/s^2
    double speed = 1.0;                     ///< share of the velocities that limits allow
    bool jerkLimited = false;
  } timing;

  struct Trajectory {
    std::string file;
    std::string start;  ///< state at time 0; empty: the first point's
    bool repair = false;
  } trajectory;

  struct Schedule {
    std::vector<std::string> parts;   ///< GROUP=FILE
    std::vector<std::string> starts;  ///< GROUP=S
    std::vector<std::string> late;    ///< GROUP=S
    std::vector<std::string> slow;    ///< GROUP=PERCENT
    std::vector<std::string> plans;   ///< GROUP=START..GOAL
  } schedule;

  std::int64_t budget = 20'000'000;  ///< per pair of links
  int samples = 1000;                ///< per pair of links
  std::optional<double> acmTime;     ///< s; none: see acm

  struct ToolLine {
    std::vector<std::string> to;  ///< X,Y,Z[,QX,QY,QZ,QW], m, model frame
    std::vector<std::string> by;  ///< X,Y,Z, m
    std::string frame = "world";  ///< of `by`: `world` or `tool`
    std::string tool;             ///< link_from_tool; empty: the link's own frame
    std::string deviation;        ///< MM[,DEG]; empty: the default
  } toolLine;

  struct Cover {
    std::optional<int> spheres;    ///< of all links; of other shapes, too
    std::optional<double> excess;  ///< m
    std::string shape = "sphere";  ///< sphere, capsule, box or convex
    std::string format;            ///< of the output; empty: by its ending
    std::string check;             ///< file of a model to judge; empty: one is searched for
    bool visual = false;
  } cover;

  struct Roadmap {
    std::string file;     ///< that `update` and `query` read
    int states = 2000;    ///< to sample
    int neighbours = 10;  ///< of each state
  } roadmap;

  struct Report {
    int motions = 1000;                                                     ///< over all worlds
    std::vector<double> resolutions = {0.2, 0.1, 0.05, 0.02, 0.01, 0.005};  ///< share of the extent
    std::vector<double> tolerances = {0.1, 0.03, 0.01, 0.003, 0.001, 1e-4};  ///< m
    int every = 1;     ///< only each so many-th problem
    std::string csv;   ///< empty: no such file
    std::string svg;   ///< how the names of the pictures begin; empty: none
    std::string html;  ///< empty: no page
  } report;

  struct Page {
    std::string file;         ///< empty: no page
    std::string commandLine;  ///< as it could be typed again in a shell
  } page;
};

/// The result of reading a command line: something to run, or nothing, because all is printed.
struct ParsedArguments {
  std::optional<Arguments> run;
  int exitCode = 0;  ///< meaningful when there is nothing to run
};

/// Reads a command line. Help goes to stdout (exit code 0), usage errors to stderr (3).
ParsedArguments parseArguments(int argc, const char* const* argv);

/// The largest margin of any pair (m).
inline double largestMargin(const Arguments& args) {
  return std::max(args.selfMargin.value_or(args.margin), args.worldMargin.value_or(args.margin));
}

}  // namespace swept
