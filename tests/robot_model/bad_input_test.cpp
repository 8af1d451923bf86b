// SPDX-License-Identifier: BSD-3-Clause
//
// Broken inputs and the exact messages they give. In texts, `@` stands for the folder of the files.
#include <gtest/gtest.h>

#include <cstdlib>

#include "input_files.hpp"
#include "swept/robot_model/problems.hpp"
#include "swept/robot_model/robot.hpp"
#include "swept/robot_model/world.hpp"

namespace swept {
namespace {

namespace fs = std::filesystem;

struct BadInput {
  std::string name;
  std::string file;  ///< its ending says what reads it
  std::string text;
  std::string message;
};

void PrintTo(const BadInput& input, std::ostream* out) {
  *out << input.name;
}

/// `body` starts at line 2.
std::string robot(const std::string& body) {
  return "<robot name='r'>\n" + body + "\n</robot>\n";
}

/// `joint` starts at line 4.
std::string joined(const std::string& joint) {
  return robot("<link name='a'/>\n<link name='b'/>\n" + joint);
}

/// `inside` starts at line 5, between the joint's parent and its end.
std::string revolute(const std::string& inside) {
  return joined("<joint name='j' type='revolute'><parent link='a'/><child link='b'/>\n" + inside +
                "\n</joint>");
}

/// `geometry` is at line 4.
std::string shaped(const std::string& geometry) {
  return robot("<link name='a'>\n<collision><geometry>\n" + geometry +
               "\n</geometry></collision></link>");
}

/// `entries` start at line 3.
std::string scene(const std::string& entries) {
  return "world:\n  collision_objects:\n" + entries;
}

/// A box, whose `extra` starts at line 4.
std::string boxed(const std::string& extra) {
  return scene("    - id: crate\n" + extra);
}

/// One problem of set `s`, with one key of it replaced.
std::string problem(const std::string& world, const std::string& rest) {
  return "{\"s\": [{\"index\": 4, \"world\": " + world + ", " + rest + "}]}";
}

const std::string kGoodRest = R"("joint_names": ["j"], "start": [0], "goals": [[1]])";

/// Links a - b - c; joints j (revolute) and k (floating).
const std::string kGoodUrdf = robot(
    "<link name='a'/><link name='b'/><link name='c'/>\n"
    "<joint name='j' type='revolute'><parent link='a'/><child link='b'/>"
    "<limit lower='-1' upper='1'/></joint>\n"
    "<joint name='k' type='floating'><parent link='b'/><child link='c'/></joint>");

std::vector<BadInput> urdfDocuments() {
  return {
      {"Empty", "r.urdf", "", "@/r.urdf:1: error: malformed XML: the document is empty"},
      {"TagsDoNotMatch", "r.urdf", "<robot name='r'>\n<link name='a'>\n</robot>\n",
       "@/r.urdf:2: error: malformed XML: an opening and a closing tag do not match"},
      {"BrokenAttribute", "r.urdf", "<robot name='r'>\n<link name=a/>\n</robot>\n",
       "@/r.urdf:2: error: malformed XML: an attribute cannot be parsed"},
      {"NoRobot", "r.urdf", "\n<sdf/>\n",
       "@/r.urdf:2: error: the root element must be <robot>, not <sdf>"},
      {"OnlyAComment", "r.urdf", "<!-- nothing -->\n",
       "@/r.urdf:1: error: the root element must be <robot>, there is none"},
      {"TwoRoots", "r.urdf", "<robot name='r'><link name='a'/></robot>\n<robot name='s'/>\n",
       "@/r.urdf:2: error: <robot> follows the root element; one root is allowed"},
      {"RobotWithoutName", "r.urdf", "<robot>\n<link name='a'/></robot>\n",
       "@/r.urdf:1: error: <robot> has no attribute 'name'"},
      {"NoLinks", "r.urdf", robot(""), "@/r.urdf:1: error: the robot has no links"},
      {"Xacro", "r.urdf", robot("<xacro:include filename='x'/>"),
       "@/r.urdf:2: error: <xacro:include> is not expanded; run xacro on the file first, or let "
       "swept do it with --xacro"},
      {"RefusedByUrdfdom", "r.urdf", "<robot name='r' version='7.3'>\n<link name='a'/></robot>\n",
       "@/r.urdf:1: error: urdfdom refuses the robot: Invalid 'version' specified; only version "
       "1.0 is "
       "currently supported"},
  };
}

std::vector<BadInput> urdfTrees() {
  const std::string fixedBA =
      "<joint name='k' type='fixed'><parent link='b'/><child link='a'/></joint>";
  const std::string fixedAB =
      "<joint name='j' type='fixed'><parent link='a'/><child link='b'/></joint>\n";
  return {
      {"LinkWithoutName", "r.urdf", robot("<link/>"),
       "@/r.urdf:2: error: <link> has no attribute 'name'"},
      {"LinkWithEmptyName", "r.urdf", robot("<link name=''/>"),
       "@/r.urdf:2: error: <link name=\"\"> must not be empty"},
      {"DuplicateLink", "r.urdf", robot("<link name='a'/>\n<link name='a'/>"),
       "@/r.urdf:3: error: a second link is named 'a'; the first is at line 2"},
      {"DuplicateJoint", "r.urdf", joined(fixedAB + fixedAB),
       "@/r.urdf:5: error: a second joint is named 'j'; the first is at line 4"},
      {"UnknownParent", "r.urdf",
       joined("<joint name='j' type='fixed'><parent link='x'/><child link='b'/></joint>"),
       "@/r.urdf:4: error: joint 'j': its parent link 'x' does not exist"},
      {"UnknownChild", "r.urdf",
       joined("<joint name='j' type='fixed'><parent link='a'/><child link='x'/></joint>"),
       "@/r.urdf:4: error: joint 'j': its child link 'x' does not exist"},
      {"JointToItself", "r.urdf",
       joined("<joint name='j' type='fixed'><parent link='b'/><child link='b'/></joint>"),
       "@/r.urdf:4: error: joint 'j' joins link 'b' to itself"},
      {"TwoParents", "r.urdf",
       robot("<link name='a'/><link name='b'/><link name='c'/>\n"
             "<joint name='j' type='fixed'><parent link='a'/><child link='c'/></joint>\n"
             "<joint name='k' type='fixed'><parent link='b'/><child link='c'/></joint>"),
       "@/r.urdf:4: error: link 'c' is the child of joint 'j' and of joint 'k'; a link has one "
       "parent"},
      {"TwoRootLinks", "r.urdf", robot("<link name='a'/>\n<link name='b'/>"),
       "@/r.urdf:3: error: links 'a' and 'b' are both roots; every link but one must be the child "
       "of a "
       "joint"},
      {"LoopWithoutRoot", "r.urdf", joined(fixedAB + fixedBA),
       "@/r.urdf:5: error: the joints form a loop: 'a' -> 'b' -> 'a'; links must form a tree"},
      {"LoopBesideTheTree", "r.urdf",
       robot("<link name='root'/>\n<link name='a'/><link name='b'/>\n" + fixedAB + fixedBA),
       "@/r.urdf:5: error: the joints form a loop: 'a' -> 'b' -> 'a'; links must form a tree"},
  };
}

std::vector<BadInput> urdfJoints() {
  const std::string limit = "<limit lower='0' upper='1'/>";
  return {
      {"JointWithoutParent", "r.urdf",
       joined("<joint name='j' type='fixed'><child link='b'/></joint>"),
       "@/r.urdf:4: error: joint 'j' has no <parent>"},
      {"JointWithoutChild", "r.urdf",
       joined("<joint name='j' type='fixed'><parent link='a'/></joint>"),
       "@/r.urdf:4: error: joint 'j' has no <child>"},
      {"ParentWithoutLink", "r.urdf",
       joined("<joint name='j' type='fixed'>\n<parent/><child link='b'/></joint>"),
       "@/r.urdf:5: error: <parent> of joint 'j' has no attribute 'link'"},
      {"JointWithoutType", "r.urdf", joined("<joint name='j'/>"),
       "@/r.urdf:4: error: <joint> of joint 'j' has no attribute 'type'"},
      {"UnknownJointType", "r.urdf", joined("<joint name='j' type='hinge'/>"),
       "@/r.urdf:4: error: joint 'j' has the unknown type 'hinge'; allowed are revolute, "
       "continuous, "
       "prismatic, fixed, floating and planar"},
      {"ZeroAxis", "r.urdf", revolute("<axis xyz='0 0 0'/>" + limit),
       "@/r.urdf:5: error: <axis xyz=\"0 0 0\"> of joint 'j' must not be zero"},
      {"NotANumberInAxis", "r.urdf", revolute("<axis xyz='0 nan 1'/>" + limit),
       "@/r.urdf:5: error: <axis xyz=\"0 nan 1\"> of joint 'j' must be 3 finite numbers separated "
       "by "
       "spaces"},
      {"NoLimit", "r.urdf", revolute(""),
       "@/r.urdf:4: error: joint 'j' has no <limit>; revolute and prismatic joints need one"},
      {"TwoLimits", "r.urdf", revolute(limit + "\n" + limit),
       "@/r.urdf:6: error: joint 'j' has a second <limit>; one is allowed"},
      {"LimitsReversed", "r.urdf", revolute("<limit lower='1.5' upper='-1'/>"),
       "@/r.urdf:5: error: <limit> of joint 'j' has lower 1.5 above upper -1"},
      {"InfiniteLimit", "r.urdf", revolute("<limit lower='0' upper='inf'/>"),
       "@/r.urdf:5: error: <limit upper=\"inf\"> of joint 'j' must be a finite number"},
      {"CommaInNumber", "r.urdf", revolute("<limit lower='0' upper='1,5'/>"),
       "@/r.urdf:5: error: <limit upper=\"1,5\"> of joint 'j' must be a finite number"},
      {"TextInVelocity", "r.urdf", revolute("<limit lower='0' upper='1' velocity='fast'/>"),
       "@/r.urdf:5: error: <limit velocity=\"fast\"> of joint 'j' must be a finite number"},
      {"NumberTooLarge", "r.urdf", revolute("<limit lower='0' upper='1e400'/>"),
       "@/r.urdf:5: error: <limit upper=\"1e400\"> of joint 'j' must be a finite number"},
      {"TwoNumbersInOrigin", "r.urdf", revolute("<origin xyz='0 0'/>" + limit),
       "@/r.urdf:5: error: <origin xyz=\"0 0\"> of joint 'j' must be 3 finite numbers separated by "
       "spaces"},
      {"UnexpandedExpression", "r.urdf", revolute("<origin rpy='0 ${pi/2} 0'/>" + limit),
       "@/r.urdf:5: error: <origin rpy=\"0 ${pi/2} 0\"> of joint 'j' must be 3 finite numbers "
       "separated by spaces"},
      {"TurnedAxis", "r.urdf", revolute("<axis xyz='1 0 0' rpy='0 0.1 0'/>" + limit),
       "@/r.urdf:5: error: <axis> of joint 'j': unknown attribute 'rpy'; allowed are xyz"},
      {"QuaternionOrigin", "r.urdf", revolute("<origin quat_xyzw='0 0 0 0'/>" + limit),
       "@/r.urdf:5: error: <origin quat_xyzw=\"0 0 0 0\"> of joint 'j' is not supported; give the "
       "rotation as rpy"},
  };
}

std::vector<BadInput> urdfMimics() {
  const auto three = [](const std::string& k, const std::string& l) {
    return robot(
        "<link name='a'/><link name='b'/><link name='c'/><link name='d'/>\n"
        "<joint name='f' type='fixed'><parent link='a'/><child link='b'/></joint>\n"
        "<joint name='k' type='continuous'><parent link='b'/><child link='c'/>\n" +
        k + "</joint>\n<joint name='l' type='continuous'><parent link='c'/><child link='d'/>\n" +
        l + "</joint>");
  };
  return {
      {"MimicOfItself", "r.urdf", three("<mimic joint='k'/>", ""),
       "@/r.urdf:5: error: joint 'k' mimics itself"},
      {"MimicLoop", "r.urdf", three("<mimic joint='l'/>", "<mimic joint='k'/>"),
       "@/r.urdf:5: error: joint 'k' mimics itself through other joints"},
      {"FloatingMimic", "r.urdf",
       joined("<joint name='j' type='floating'><parent link='a'/><child link='b'/>\n"
              "<mimic joint='j'/></joint>"),
       "@/r.urdf:5: error: joint 'j' cannot mimic: only revolute, continuous and prismatic joints "
       "can"},
      {"MimicMultiplier", "r.urdf", three("", "<mimic joint='k' multiplier='x2'/>"),
       "@/r.urdf:7: error: <mimic multiplier=\"x2\"> of joint 'l' must be a finite number"},
      {"MimicOverflow", "r.urdf", three("", "<mimic joint='k' multiplier='1e308'/>"),
       "@/r.urdf:7: error: joint 'l' mimics 'k' and its values are not finite"},
  };
}

std::vector<BadInput> urdfShapes() {
  return {
      {"CollisionWithoutGeometry", "r.urdf", robot("<link name='a'>\n<collision/></link>"),
       "@/r.urdf:3: error: <collision> of link 'a' has no <geometry>"},
      {"EmptyGeometry", "r.urdf",
       robot("<link name='a'><collision>\n<geometry/></collision></link>"),
       "@/r.urdf:3: error: <geometry> of link 'a' is empty; it must hold box, cylinder, sphere, "
       "capsule "
       "or mesh"},
      {"UnknownGeometry", "r.urdf", shaped("<torus radius='1'/>"),
       "@/r.urdf:4: error: <torus> in <geometry> of link 'a' is unknown; allowed are box, "
       "cylinder, "
       "sphere, capsule and mesh"},
      {"TwoShapes", "r.urdf", shaped("<sphere radius='1'/>\n<sphere radius='2'/>"),
       "@/r.urdf:5: error: <geometry> of link 'a' holds a second shape <sphere>; one is allowed"},
      {"NegativeBox", "r.urdf", shaped("<box size='1 -1 1'/>"),
       "@/r.urdf:4: error: <box size=\"1 -1 1\"> of link 'a' must have three sizes of 0 or "
       "greater"},
      {"BoxWithoutSize", "r.urdf", shaped("<box/>"),
       "@/r.urdf:4: error: <box> of link 'a' has no attribute 'size'"},
      {"NegativeSphere", "r.urdf", shaped("<sphere radius='-0.1'/>"),
       "@/r.urdf:4: error: <sphere radius=\"-0.1\"> of link 'a' must be 0 or greater"},
      {"NegativeCylinder", "r.urdf", shaped("<cylinder radius='0' length='-1'/>"),
       "@/r.urdf:4: error: <cylinder length=\"-1\"> of link 'a' must be 0 or greater"},
      {"UnknownAttributeOfShape", "r.urdf", shaped("<sphere radius='1' diameter='2'/>"),
       "@/r.urdf:4: error: <sphere> of link 'a': unknown attribute 'diameter'; allowed are radius"},
      {"MisspeltCollision", "r.urdf", robot("<link name='a'>\n<Colision/></link>"),
       "@/r.urdf:3: error: link 'a': unknown element <Colision>; is <collision> meant?"},
      {"GeometryInUnknownElement", "r.urdf",
       robot("<link name='a'>\n<shape><geometry/></shape></link>"),
       "@/r.urdf:3: error: link 'a': unknown element <shape> holds geometry; allowed are "
       "collision"},
      {"MisspeltJoint", "r.urdf", robot("<link name='a'/>\n<jiont name='j'/>"),
       "@/r.urdf:3: error: <robot>: unknown element <jiont>; is <joint> meant?"},
      {"InfiniteCylinder", "r.urdf", shaped("<cylinder radius='1' length='inf'/>"),
       "@/r.urdf:4: error: <cylinder length=\"inf\"> of link 'a' must be a finite number"},
      {"CapsuleWithoutLength", "r.urdf", shaped("<capsule radius='1'/>"),
       "@/r.urdf:4: error: <capsule> of link 'a' has no attribute 'length'"},
  };
}

std::vector<BadInput> meshes() {
  return {
      {"MeshWithoutFile", "r.urdf", shaped("<mesh/>"),
       "@/r.urdf:4: error: <mesh> of link 'a' has no attribute 'filename'"},
      {"MeshNotFound", "r.urdf", shaped("<mesh filename='x/../y.stl'/>"),
       "@/r.urdf:4: error: mesh 'x/../y.stl' of link 'a' not found; looked for @/y.stl"},
      {"MeshFolder", "r.urdf", shaped("<mesh filename='file://@'/>"),
       "@/r.urdf:4: error: mesh 'file://@' of link 'a' not found; looked for @ (not a regular "
       "file)"},
      {"MeshFromTheNet", "r.urdf", shaped("<mesh filename='https://host/y.stl'/>"),
       "@/r.urdf:4: error: mesh 'https://host/y.stl' of link 'a': the scheme must be package://, "
       "model:// "
       "or file://"},
      {"MeshUnreadable", "r.urdf", shaped("<mesh filename='garbage.stl'/>"),
       "@/r.urdf:4: error: mesh 'garbage.stl' of link 'a' cannot be read: neither STL as text, "
       "which starts with 'solid', nor a binary one: it has 12 bytes, less than the 84 of a "
       "header"},
      {"MeshOfUnknownKind", "r.urdf", shaped("<mesh filename='notes.txt'/>"),
       "@/r.urdf:4: error: mesh 'notes.txt' of link 'a' has the ending '.txt'; allowed are .stl, "
       ".obj, .dae, .ply, .off, .gltf and .glb"},
      {"MeshWithoutTriangles", "r.urdf", shaped("<mesh filename='lines.obj'/>"),
       "@/r.urdf:4: error: mesh 'lines.obj' of link 'a' has no triangles"},
      {"MeshAllDegenerate", "r.urdf", shaped("<mesh filename='needle.obj'/>"),
       "@/r.urdf:4: error: mesh 'needle.obj' of link 'a': mesh has no triangle with three distinct "
       "corners (of 1 given)"},
      {"MeshScaleZero", "r.urdf", shaped("<mesh filename='needle.obj' scale='1 0 1'/>"),
       "@/r.urdf:4: error: <mesh scale=\"1 0 1\"> of link 'a' must have three factors other than "
       "0"},
      {"MeshScaleCount", "r.urdf", shaped("<mesh filename='needle.obj' scale='0.001'/>"),
       "@/r.urdf:4: error: <mesh scale=\"0.001\"> of link 'a' must be 3 finite numbers separated "
       "by "
       "spaces"},
  };
}

std::vector<BadInput> srdfs() {
  return {
      {"SrdfEmpty", "r.srdf", "", "@/r.srdf:1: error: malformed XML: the document is empty"},
      {"SrdfNotClosed", "r.srdf", "<robot name='r'>\n<group name='g'>",
       "@/r.srdf:2: error: malformed XML: an opening and a closing tag do not match"},
      {"GroupWithoutName", "r.srdf", robot("<group/>"),
       "@/r.srdf:2: error: <group> has no attribute 'name'"},
      {"DuplicateGroup", "r.srdf", robot("<group name='g'/>\n<group name='g'/>"),
       "@/r.srdf:3: error: a second group is named 'g'"},
      {"ChainWithoutTip", "r.srdf", robot("<group name='g'>\n<chain base_link='a'/></group>"),
       "@/r.srdf:3: error: <chain> of group 'g' has no attribute 'tip_link'"},
      {"GroupLoop", "r.srdf",
       robot("<group name='g'>\n<group name='h'/></group>\n<group name='h'>\n<group "
             "name='g'/></group>"),
       "@/r.srdf:5: error: group 'g' contains itself"},
      {"UnknownElementInGroup", "r.srdf", robot("<group name='g'>\n<jiont name='j'/></group>"),
       "@/r.srdf:3: error: group 'g': unknown element <jiont>; allowed are chain, joint, link and "
       "group"},
      {"StateWithTwoValues", "r.srdf",
       robot("<group_state name='s' group='all'>\n<joint name='j' value='0 0'/></group_state>"),
       "@/r.srdf:3: error: state 's': joint 'j' has 1 value, 2 given"},
      {"StateWithTooFewValues", "r.srdf",
       robot("<group_state name='s' group='all'>\n<joint name='k' value='0 0 0'/></group_state>"),
       "@/r.srdf:3: error: state 's': joint 'k' has 7 values, 3 given"},
      {"StateQuaternion", "r.srdf",
       robot("<group_state name='s' group='all'>\n<joint name='k' value='0 0 0 0 0 0 "
             "0'/></group_state>"),
       "@/r.srdf:3: error: state 's': the quaternion (x, y, z, w) of joint 'k' must have length 1"},
      {"StateNotANumber", "r.srdf",
       robot("<group_state name='s' group='all'>\n<joint name='j' value='pi'/></group_state>"),
       "@/r.srdf:3: error: <joint value=\"pi\"> of state 's' must be finite numbers"},
      {"StateSetsTwice", "r.srdf",
       robot("<group_state name='s' group='all'>\n<joint name='j' value='0'/>\n"
             "<joint name='j' value='0'/></group_state>"),
       "@/r.srdf:4: error: state 's' sets joint 'j' twice"},
      {"DuplicateState", "r.srdf",
       robot("<group_state name='s' group='all'/>\n<group_state name='s' group='all'/>"),
       "@/r.srdf:3: error: group 'all' has a second state 's'"},
      {"VirtualJointType", "r.srdf",
       robot("<virtual_joint name='v' type='revolute' parent_frame='world' child_link='a'/>"),
       "@/r.srdf:2: error: virtual joint 'v' has the unknown type 'revolute'; allowed are fixed, "
       "planar "
       "and floating"},
      {"VirtualJointChild", "r.srdf",
       robot("<virtual_joint name='v' type='fixed' parent_frame='world' child_link='b'/>"),
       "@/r.srdf:2: error: virtual joint 'v': its child link 'b' must be the root link 'a'"},
      {"VirtualJointName", "r.srdf",
       robot("<virtual_joint name='j' type='fixed' parent_frame='world' child_link='a'/>"),
       "@/r.srdf:2: error: virtual joint 'j': the URDF has a joint of that name"},
      {"TwoVirtualJoints", "r.srdf",
       robot("<virtual_joint name='v' type='fixed' parent_frame='world' child_link='a'/>\n"
             "<virtual_joint name='w' type='fixed' parent_frame='world' child_link='a'/>"),
       "@/r.srdf:3: error: virtual joint 'w' is a second virtual joint; the root link has one "
       "parent"},
      {"UnknownElement", "r.srdf", robot("<enable_colisions link1='a' link2='b'/>"),
       "@/r.srdf:2: error: unknown element <enable_colisions> in <robot>"},
      {"UnknownElementOfAState", "r.srdf",
       robot("<group_state name='s' group='all'>\n<jiont name='j' value='0'/></group_state>"),
       "@/r.srdf:3: error: unknown element <jiont> in <group_state>"},
      {"UnknownAttribute", "r.srdf",
       robot("<disable_collisions link1='a' link2='b' unless='held'/>"),
       "@/r.srdf:2: error: unknown attribute 'unless' of <disable_collisions>"},
      {"BlankName", "r.srdf", robot("<passive_joint name=' '/>"),
       "@/r.srdf:2: error: <passive_joint name=\" \"> must not be blank"},
      {"DisableWithoutLink", "r.srdf", robot("<disable_collisions link1='a'/>"),
       "@/r.srdf:2: error: <disable_collisions> has no attribute 'link2'"},
  };
}

std::vector<BadInput> yamlScenes() {
  const std::string box = "      primitives: [{type: box, dimensions: [1, 1, 1]}]\n";
  return {
      {"YamlSyntax", "s.yaml", "world:\n  collision_objects: [\n",
       "@/s.yaml:3: error: malformed YAML: end of sequence flow not found"},
      {"YamlNested", "s.yaml", "world:\n  " + std::string(100'000, '['),
       "@/s.yaml:2: error: malformed YAML: mappings and lists are nested too deeply"},
      {"YamlList", "s.yaml", "- 1\n", "@/s.yaml:1: error: a planning scene must be a mapping"},
      {"YamlNoObjects", "s.yaml", "name: x\n",
       "@/s.yaml:1: error: a planning scene needs 'world' or 'collision_objects'"},
      {"ObjectsTwice", "s.yaml", scene("    []\n") + "collision_objects: []\n",
       "@/s.yaml:4: error: collision_objects stand at the top and in 'world' too; one place is "
       "allowed"},
      {"ObjectsNoList", "s.yaml", "collision_objects:\n  id: a\n",
       "@/s.yaml:2: error: collision_objects must be a list"},
      {"ObjectWithoutId", "s.yaml", scene("    - primitives: []\n"),
       "@/s.yaml:3: error: collision_objects[0].id is missing"},
      {"DuplicateObject", "s.yaml", boxed(box) + "    - id: crate\n" + box,
       "@/s.yaml:5: error: object 'crate': a second object has this id"},
      {"ObjectWithoutShapes", "s.yaml", boxed(""),
       "@/s.yaml:3: error: object 'crate': it has no primitives, no meshes and no planes"},
      {"RemovedObject", "s.yaml", boxed("      operation: remove\n" + box),
       "@/s.yaml:4: error: object 'crate': operation is 'remove'; a scene file allows only add "
       "(0)"},
      {"UnknownPrimitive", "s.yaml",
       boxed("      primitives: [{type: prism, dimensions: [1, 1]}]\n"),
       "@/s.yaml:4: error: object 'crate': primitives[0].type is 'prism'; allowed are box (1), "
       "sphere (2), cylinder (3) and cone (4)"},
      {"ConeDimensions", "s.yaml", boxed("      primitives: [{type: 4, dimensions: [1]}]\n"),
       "@/s.yaml:4: error: object 'crate': primitives[0].dimensions has 1 values; a cone has 2 "
       "[height, radius]"},
      {"BoxDimensions", "s.yaml",
       boxed("      primitives:\n      - type: box\n        dimensions: [1, 1]\n"),
       "@/s.yaml:6: error: object 'crate': primitives[0].dimensions has 2 values; a box has 3 [x, "
       "y, z]"},
      {"CylinderDimensions", "s.yaml",
       boxed("      primitives: [{type: cylinder, dimensions: [1]}]\n"),
       "@/s.yaml:4: error: object 'crate': primitives[0].dimensions has 1 values; a cylinder has 2 "
       "[height, radius]"},
      {"NegativeDimension", "s.yaml",
       boxed("      primitives: [{type: sphere, dimensions: [-1]}]\n"),
       "@/s.yaml:4: error: object 'crate': primitives[0].dimensions[0] is '-1'; it must be 0 or "
       "greater"},
      {"DimensionNotFinite", "s.yaml",
       boxed("      primitives: [{type: sphere, dimensions: [.inf]}]\n"),
       "@/s.yaml:4: error: object 'crate': primitives[0].dimensions[0] is '.inf'; it must be a "
       "finite "
       "number"},
      {"PoseCount", "s.yaml", boxed(box + "      primitive_poses: [{}, {}]\n"),
       "@/s.yaml:5: error: object 'crate': primitive_poses has 2 entries for 1 primitives"},
      {"PositionCount", "s.yaml", boxed(box + "      primitive_poses:\n      - position: [1, 2]\n"),
       "@/s.yaml:6: error: object 'crate': primitive_poses[0].position must be 3 numbers [x, y, "
       "z]"},
      {"PositionKey", "s.yaml", boxed(box + "      pose: {position: {x: 1, y: 2}}\n"),
       "@/s.yaml:5: error: object 'crate': pose.position.z is missing"},
      {"Quaternion", "s.yaml", boxed(box + "      pose: {orientation: [0, 0, 0, 2]}\n"),
       "@/s.yaml:5: error: object 'crate': pose.orientation is a quaternion (x, y, z, w) of length "
       "2; it "
       "must be 1 to within 0.01"},
      {"PlaneCoefficients", "s.yaml", boxed("      planes: [{coef: [0, 0, 1]}]\n"),
       "@/s.yaml:4: error: object 'crate': planes[0].coef has 3 values; a plane has 4 [a, b, c, "
       "d]"},
      {"PlaneNormal", "s.yaml", boxed("      planes: [{coef: [0, 0, 0, 1]}]\n"),
       "@/s.yaml:4: error: object 'crate': planes[0].coef cannot be used: plane has normal (0, "
       "0, 0) and offset -1; allowed: finite numbers, a normal that is not zero"},
      {"Octomap", "s.yaml", "world:\n  octomap:\n    octomap:\n      data: [1, 2]\n",
       "@/s.yaml:4: error: world.octomap.octomap.data holds an octomap, which is not supported in "
       "a "
       "scene"},
      {"MeshIndices", "s.yaml",
       boxed("      meshes: [{vertices: [[0, 0, 0], [1, 0, 0], [0, 1, 0]], triangles: [[0, 1, "
             "7]]}]\n"),
       "@/s.yaml:4: error: object 'crate': meshes[0] cannot be used: mesh triangle 0 has corner 7; "
       "allowed: 0 to 2"},
      {"MeshTriangle", "s.yaml",
       boxed("      meshes: [{vertices: [[0, 0, 0]], triangles: [[0, 1]]}]\n"),
       "@/s.yaml:4: error: object 'crate': meshes[0].triangles[0] must hold 3 vertex indices"},
      {"MeshResource", "s.yaml", boxed("      meshes: [{resource: y.stl}]\n"),
       "@/s.yaml:4: error: mesh 'y.stl' of object 'crate' not found; looked for @/y.stl"},
      {"MotionNoList", "s.yaml", boxed(box + "      motion: {time: 0}\n"),
       "@/s.yaml:5: error: object 'crate': motion must be a list"},
      {"MotionEmpty", "s.yaml", boxed(box + "      motion: []\n"),
       "@/s.yaml:5: error: object 'crate': motion has no waypoint; one at least is needed, and an "
       "object that stands has none"},
      {"MotionNoMapping", "s.yaml", boxed(box + "      motion: [1]\n"),
       "@/s.yaml:5: error: object 'crate': motion[0] must be a mapping"},
      {"MotionUnknownKey", "s.yaml",
       boxed(box + "      motion: [{time: 0, position: [0, 0, 0], speed: 1}]\n"),
       "@/s.yaml:5: error: object 'crate': motion[0] has the unknown key 'speed'; allowed are "
       "time, position and orientation"},
      {"MotionWithoutTime", "s.yaml", boxed(box + "      motion: [{position: [0, 0, 0]}]\n"),
       "@/s.yaml:5: error: object 'crate': motion[0].time is missing"},
      {"MotionTimeNotFinite", "s.yaml",
       boxed(box + "      motion: [{time: .inf, position: [0, 0, 0]}]\n"),
       "@/s.yaml:5: error: object 'crate': motion[0].time is '.inf'; it must be a finite number"},
      {"MotionTimeNotLater", "s.yaml",
       boxed(box + "      motion:\n      - {time: 1, position: [0, 0, 0]}\n" +
             "      - {time: 1, position: [1, 0, 0]}\n"),
       "@/s.yaml:7: error: object 'crate': motion[1].time is 1; it must be later than that of the "
       "waypoint before"},
      {"MotionWithoutPosition", "s.yaml", boxed(box + "      motion: [{time: 0}]\n"),
       "@/s.yaml:5: error: object 'crate': motion[0].position is missing"},
      {"MotionPosition", "s.yaml", boxed(box + "      motion: [{time: 0, position: [0, 1]}]\n"),
       "@/s.yaml:5: error: object 'crate': motion[0].position must be 3 numbers [x, y, z]"},
      {"MotionQuaternion", "s.yaml",
       boxed(box + "      motion: [{time: 0, position: [0, 0, 0], orientation: [0, 0, 0, 0]}]\n"),
       "@/s.yaml:5: error: object 'crate': motion[0].orientation is a quaternion (x, y, z, w) of "
       "length 0; it must be 1 to within 0.01"},
      {"MotionAndPose", "s.yaml",
       boxed(box + "      pose: {}\n      motion: [{time: 0, position: [0, 0, 0]}]\n"),
       "@/s.yaml:5: error: object 'crate': pose and motion say where the object is; one of them is "
       "allowed"},
      {"MotionOfPlanes", "s.yaml",
       boxed("      planes: [{coef: [0, 0, 1, 0]}]\n"
             "      motion: [{time: 0, position: [0, 0, 0]}]\n"),
       "@/s.yaml:4: error: object 'crate': planes are of an object with a motion; what has no "
       "bounds cannot move"},
      {"MotionOfSubframes", "s.yaml",
       boxed(box + "      subframe_names: [lid]\n      subframe_poses: [{}]\n"
                   "      motion: [{time: 0, position: [0, 0, 0]}]\n"),
       "@/s.yaml:5: error: object 'crate': subframe_names are of an object with a motion; nothing "
       "can be placed by it"},
      {"MotionWithoutShapes", "s.yaml", boxed("      motion: [{time: 0, position: [0, 0, 0]}]\n"),
       "@/s.yaml:3: error: object 'crate': it has no primitives, no meshes and no planes"},
      {"MotionOfAFrame", "s.yaml",
       boxed(box +
             "      motion: [{time: 0, position: [0, 0, 0]}]\n"
             "    - id: lid\n      header: {frame_id: crate}\n" +
             box),
       "@/s.yaml:7: error: object 'lid': header.frame_id is 'crate', an object that moves; a frame "
       "has to stand"},
      {"MotionTwice", "s.yaml",
       boxed(box + "      motion: [{time: 0, position: [0, 0, 0]}]\n    - id: crate\n" + box),
       "@/s.yaml:6: error: object 'crate': a second object has this id"},
      {"SceneEnding", "s.txt", "x",
       "@/s.txt: error: unknown ending '.txt' of a scene file; allowed are "
       ".yaml, .yml, .scene and .urdf"},
  };
}

/// What was ignored without a word.
std::vector<BadInput> yamlKeys() {
  const std::string box = "      primitives: [{type: box, dimensions: [1, 1, 1]}]\n";
  const std::string objectKeys =
      "header, pose, id, type, primitives, primitive_poses, meshes, mesh_poses, planes, "
      "plane_poses, subframe_names, subframe_poses, operation and motion";
  return {
      {"SceneKey", "s.yaml", "wrold: 1\nworld: {}\n",
       "@/s.yaml:1: error: the file has the unknown key 'wrold'; allowed are name, robot_state, "
       "robot_model_name, fixed_frame_transforms, allowed_collision_matrix, link_padding, "
       "link_scale, object_colors, world, collision_objects and is_diff"},
      {"SceneKeyTwice", "s.yaml", "world: {}\nname: a\nworld: {collision_objects: []}\n",
       "@/s.yaml:3: error: the file has the key 'world' twice"},
      {"WorldKey", "s.yaml", "world:\n  colision_objects: []\n",
       "@/s.yaml:2: error: world has the unknown key 'colision_objects'; allowed are "
       "collision_objects and octomap"},
      {"ObjectKey", "s.yaml", boxed(box + "      primitve_poses: [{position: [1, 2, 3]}]\n"),
       "@/s.yaml:5: error: object 'crate': has the unknown key 'primitve_poses'; allowed are " +
           objectKeys},
      {"ObjectKeyTwice", "s.yaml", boxed(box + box),
       "@/s.yaml:5: error: object 'crate': has the key 'primitives' twice"},
      {"ObjectMerged", "s.yaml", boxed(box + "      <<: {pose: {position: [1, 2, 3]}}\n"),
       "@/s.yaml:5: error: object 'crate': has the unknown key '<<'; allowed are " + objectKeys},
      {"KeyIsAList", "s.yaml", boxed(box + "      ? [pose]\n      : 1\n"),
       "@/s.yaml:5: error: object 'crate': has a key that is not a single value"},
      {"PoseKey", "s.yaml",
       boxed(box + "      pose: {position: [1, 2, 3], rotation: [0, 0, 0, 1]}\n"),
       "@/s.yaml:5: error: object 'crate': pose has the unknown key 'rotation'; allowed are "
       "position and orientation"},
      {"PositionKeyUnknown", "s.yaml",
       boxed(box + "      pose: {position: {x: 1, y: 2, z: 3, w: 4}}\n"),
       "@/s.yaml:5: error: object 'crate': pose.position has the unknown key 'w'; allowed are x, y "
       "and z"},
      {"PrimitiveKey", "s.yaml",
       boxed("      primitives: [{type: sphere, dimensions: [1], radius: 2}]\n"),
       "@/s.yaml:4: error: object 'crate': primitives[0] has the unknown key 'radius'; allowed are "
       "type, dimensions and polygon"},
      {"MeshKey", "s.yaml", boxed("      meshes: [{resource: a.stl, scle: [2, 2, 2]}]\n"),
       "@/s.yaml:4: error: object 'crate': meshes[0] has the unknown key 'scle'; allowed are "
       "resource, scale and dimensions"},
      {"MeshScaleTwice", "s.yaml",
       boxed("      meshes: [{resource: a.stl, scale: [2, 2, 2], dimensions: [2, 2, 2]}]\n"),
       "@/s.yaml:4: error: object 'crate': meshes[0].dimensions and scale are two names for one "
       "thing; one is allowed"},
      {"MeshDimensionsZero", "s.yaml",
       boxed("      meshes: [{resource: a.stl, dimensions: [2, 0, 2]}]\n"),
       "@/s.yaml:4: error: object 'crate': meshes[0].dimensions must hold factors other than 0"},
      {"HeaderKey", "s.yaml", boxed(box + "      header: {frame: table}\n"),
       "@/s.yaml:5: error: object 'crate': header has the unknown key 'frame'; allowed are seq, "
       "stamp and frame_id"},
      {"SecondDocument", "s.yaml", "world: {}\n---\nworld: {}\n",
       "@/s.yaml:3: error: a second document begins; one is allowed"},
      // yaml-cpp finds empty documents there without end.
      {"NoDocument", "s.yaml", ",~-~",
       "@/s.yaml:1: error: malformed YAML: this is part of no document"},
      {"LinkPadding", "s.yaml",
       "world: {}\nlink_padding:\n  - {link_name: a, padding: 0}\n  - {link_name: b, padding: "
       "0.01}\n",
       "@/s.yaml:4: error: link_padding[1].padding of link 'b' is 0.01, which is not read from a "
       "scene; give it as a rule instead (CollisionRules::pad, --pad)"},
      {"LinkScale", "s.yaml", "world: {}\nlink_scale: [{link_name: b, scale: 1.1}]\n",
       "@/s.yaml:2: error: link_scale[0].scale of link 'b' is 1.1, which is not read from a scene; "
       "give it as a rule instead (CollisionRules::scale, --scale)"},
  };
}

std::vector<BadInput> yamlNumbers() {
  std::vector<BadInput> inputs;
  const auto add = [&](const std::string& name, const std::string& number,
                       const std::string& what) {
    inputs.push_back({"Number" + name, "s.yaml",
                      boxed("      primitives: [{type: sphere, dimensions: [" + number + "]}]\n"),
                      "@/s.yaml:4: error: object 'crate': primitives[0].dimensions[0] " + what});
  };
  const auto notFinite = [](const std::string& number) {
    return "is '" + number + "'; it must be a finite number";
  };
  int i = 0;
  for (const char* number : {".inf", "-.INF", ".nan", "inf", "nan", "1e400", "0x10", "0o10", "0b1",
                             "1_000", "1:30", "1.5.2", "1e", "++1", "true", "2 m"}) {
    add(std::to_string(++i), number, notFinite(number));
  }
  add("Octal", "010", "is '010'; it must not begin with 0");
  add("SignedOctal", "+00", "is '+00'; it must not begin with 0");
  add("None", "~", "is missing");
  return inputs;
}

std::vector<BadInput> yamlFrames() {
  const auto transforms = [](const std::string& second) {
    return "world: {}\nfixed_frame_transforms:\n"
           "  - {header: {frame_id: table}, child_frame_id: base, transform: {}}\n" +
           second;
  };
  return {
      {"FrameOfTf", "s.yaml",
       transforms("  - header: {frame_id: base}\n    child_frame_id: base\n"
                  "    transform: {translation: [0, 0, 1]}\n"),
       "@/s.yaml:4: error: fixed_frame_transforms[1] moves the planning frame: child_frame_id has "
       "to name that one, header.frame_id another, whose pose in it the transform is"},
      {"FrameWithoutName", "s.yaml",
       transforms("  - child_frame_id: base\n    transform: {translation: [0, 0, 1]}\n"),
       "@/s.yaml:4: error: fixed_frame_transforms[1] moves the planning frame: child_frame_id has "
       "to name that one, header.frame_id another, whose pose in it the transform is"},
      {"FrameOfAnother", "s.yaml",
       transforms("  - header: {frame_id: tray}\n    child_frame_id: table\n    transform: {}\n"),
       "@/s.yaml:5: error: fixed_frame_transforms[1].child_frame_id is 'table'; it must be 'base', "
       "the planning frame, as in the first transform"},
      {"FrameTwice", "s.yaml",
       transforms("  - {header: {frame_id: /table}, child_frame_id: base, transform: {}}\n"),
       "@/s.yaml:4: error: fixed_frame_transforms[1] is a second transform of frame 'table'"},
      {"FrameKey", "s.yaml",
       transforms("  - {header: {frame_id: tray}, child_frame: base, transform: {}}\n"),
       "@/s.yaml:4: error: fixed_frame_transforms[1] has the unknown key 'child_frame'; allowed "
       "are "
       "header, child_frame_id and transform"},
      {"FrameWithoutTransform", "s.yaml",
       transforms("  - {header: {frame_id: tray}, child_frame_id: base}\n"),
       "@/s.yaml:4: error: fixed_frame_transforms[1].transform is missing"},
  };
}

std::vector<BadInput> textScenes() {
  return {
      {"SceneCutOff", "s.scene", "name\n* a\n1\nbox\n1 1 1\n0 0 0\n",
       "@/s.scene:6: error: object 'a': the file ends where a quaternion should follow"},
      {"SceneWithoutEnd", "s.scene", "name\n* a\n1\nsphere\n1\n0 0 0\n0 0 0 1\n0 0 0 0\n",
       "@/s.scene:8: error: the file ends where '*' or '.' should follow"},
      {"SceneGarbage", "s.scene", "name\n* a\n1\nsphere\n1\n0 0 0\n0 0 0 1\n0 0 0 0\nx\n",
       "@/s.scene:9: error: 'x' where '*' (an object) or '.' (the end) should be"},
      {"SceneAfterItsEnd", "s.scene",
       "name\n* a\n1\nsphere\n1\n0 0 0\n0 0 0 1\n0 0 0 0\n.\n\nother\n* b\n1\n",
       "@/s.scene:11: error: 'other' follows the '.' that ends the scene"},
      {"SceneShape", "s.scene", "name\n* a\n1\nprism\n1 1\n",
       "@/s.scene:4: error: object 'a': the shape 'prism' is not supported; allowed are box, "
       "sphere, cylinder, cone, plane and mesh"},
      {"ScenePlane", "s.scene", "name\n* a\n1\nplane\n0 0 0 1\n",
       "@/s.scene:5: error: object 'a': plane has normal (0, 0, 0) and offset -1; allowed: finite "
       "numbers, a "
       "normal that is not zero"},
      {"SceneSize", "s.scene", "name\n* a\n1\nbox\n1 -1 1\n",
       "@/s.scene:5: error: object 'a': the size of a box is '-1'; it must be 0 or greater"},
      {"SceneNumber", "s.scene", "name\n* a\n1\nsphere\n1\n0 zero 0\n",
       "@/s.scene:6: error: object 'a': a position is 'zero'; it must be a finite number"},
      {"SceneCount", "s.scene", "name\n* a\n1.5\n",
       "@/s.scene:3: error: object 'a': the number of shapes is '1.5'; it must be a whole number "
       "of at "
       "least 0"},
      {"SceneQuaternion", "s.scene", "name\n* a\n1\nsphere\n1\n0 0 0\n0 0 0 0\n",
       "@/s.scene:7: error: object 'a': the quaternion (x, y, z, w) has length 0; it must be 1 to "
       "within "
       "0.01"},
      {"SceneDuplicate", "s.scene",
       "name\n* a b\n1\nsphere\n1\n0 0 0\n0 0 0 1\n0 0 0 0\n* a b\n1\n.\n",
       "@/s.scene:9: error: object 'a b': a second object has this id"},
      {"SceneNoId", "s.scene", "name\n*\n1\n", "@/s.scene:2: error: an object has no id"},
      {"SceneMesh", "s.scene", "name\n* a\n1\nmesh\n3 1\n0 0 0\n1 0 0\n0 1 0\n0 1 3\n",
       "@/s.scene:4: error: object 'a': the mesh cannot be used: mesh triangle 0 has corner 3; "
       "allowed: 0 to 2"},
  };
}

std::vector<BadInput> problems() {
  const auto body = [](const std::string& kind, const std::string& entry) {
    return problem("{\"" + kind + "\": [" + entry + "]}", kGoodRest);
  };
  return {
      {"JsonSyntax", "p.json", "{\n\"s\": [\n{]}",
       "@/p.json:3: error: malformed JSON: syntax error while parsing object key - unexpected ']'; "
       "expected string literal"},
      {"JsonList", "p.json", "[]",
       "@/p.json: error: the file must be an object of problem sets { SET: [...] }"},
      {"SetNoList", "p.json", "{\"s\": 1}", "@/p.json: error: set 's' must be a list"},
      {"NoIndex", "p.json", "{\"s\": [{}]}", "@/p.json: error: set 's'[0].index is missing"},
      {"IndexIsHalf", "p.json", "{\"s\": [{\"index\": 1.5}]}",
       "@/p.json: error: set 's'[0].index is 1.5; it must be a whole number"},
      {"NumberOverflow", "p.json", "{\"s\": [1e999]}",
       "@/p.json: error: malformed JSON: number overflow parsing '1e999'"},
      {"NotUtf8", "p.json", "{\"s\": [{\"index\": \"\xff\"}]}",
       "@/p.json:1: error: malformed JSON: syntax error while parsing value - invalid string: "
       "ill-formed UTF-8 byte; last read: '\"\\u00ff'"},
      {"NoWorld", "p.json", "{\"s\": [{\"index\": 4}]}",
       "@/p.json: error: set 's' problem 4: world is missing"},
      {"UnknownKind", "p.json", body("cone", "{}"),
       "@/p.json: error: set 's' problem 4: world has the unknown key 'cone'; allowed are sphere, "
       "cylinder "
       "and box"},
      {"BodyKey", "p.json",
       body("sphere", R"({"name": "a", "radius": 1, "position": [0, 0, 0], "lenght": 1})"),
       "@/p.json: error: set 's' problem 4: world.sphere[0] has the unknown key 'lenght'; allowed "
       "are name, position, orientation, object_pose, primitive_pose and radius"},
      {"ProblemKey", "p.json", problem("{}", kGoodRest + ", \"padding\": 0.1"),
       "@/p.json: error: set 's' problem 4: has the unknown key 'padding'; allowed are index, "
       "world, joint_names, start, goals and valid"},
      {"KeyTwice", "p.json", body("sphere", R"({"name": "a", "radius": 1, "radius": 2})"),
       "@/p.json: error: s.world.sphere.radius is given twice"},
      {"SetTwice", "p.json", R"({"s": [], "s": []})", "@/p.json: error: s is given twice"},
      {"BodyWithoutName", "p.json", body("sphere", "{\"radius\": 1}"),
       "@/p.json: error: set 's' problem 4: world.sphere[0].name is missing"},
      {"NegativeRadius", "p.json",
       body("sphere", R"({"name": "a", "radius": -1, "position": [0, 0, 0]})"),
       "@/p.json: error: set 's' problem 4: world.sphere[0].radius is -1; it must be 0 or "
       "greater"},
      {"RadiusIsText", "p.json", body("sphere", R"({"name": "a", "radius": "1"})"),
       "@/p.json: error: set 's' problem 4: world.sphere[0].radius is \"1\"; it must be a finite "
       "number"},
      {"PositionOfTwo", "p.json",
       body("sphere", R"({"name": "a", "radius": 1, "position": [0, 0]})"),
       "@/p.json: error: set 's' problem 4: world.sphere[0].position holds 2 values; it must hold "
       "3"},
      {"BadOrientation", "p.json",
       body("box", R"({"name": "a", "half_extents": [1, 1, 1], "position": [0, 0, 0],)"
                   R"( "orientation": [1, 1, 0, 0]})"),
       "@/p.json: error: set 's' problem 4: world.box[0].orientation is [1,1,0,0]; it must be a "
       "quaternion (x, y, z, w) of length 1 to within 0.01"},
      {"SameBody", "p.json",
       body("sphere", R"({"name": "a", "radius": 1, "position": [0, 0, 0]}, {"name": "a"})"),
       "@/p.json: error: set 's' problem 4: world.sphere[1] is a second body named 'a'"},
      {"StartTooShort", "p.json",
       problem("{}", R"("joint_names": ["j", "k"], "start": [0], "goals": [])"),
       "@/p.json: error: set 's' problem 4: start holds 1 values; it must hold 2"},
      {"GoalTooLong", "p.json",
       problem("{}", R"("joint_names": ["j"], "start": [0], "goals": [[0, 1]])"),
       "@/p.json: error: set 's' problem 4: goals[0] holds 2 values; it must hold 1"},
      {"NoGoal", "p.json", problem("{}", R"("joint_names": ["j"], "start": [0], "goals": [])"),
       "@/p.json: error: set 's' problem 4: goals must hold at least one goal"},
  };
}

std::vector<BadInput> allInputs() {
  std::vector<BadInput> all;
  for (const auto& part :
       {urdfDocuments(), urdfTrees(), urdfJoints(), urdfMimics(), urdfShapes(), meshes(), srdfs(),
        yamlScenes(), yamlKeys(), yamlNumbers(), yamlFrames(), textScenes(), problems()}) {
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

std::string inFolder(std::string text, const fs::path& folder) {
  for (auto at = text.find('@'); at != std::string::npos; at = text.find('@')) {
    text.replace(at, 1, folder.string());
  }
  return text;
}

void load(const fs::path& file, const fs::path& goodUrdf) {
  const std::string ending = file.extension().string();
  if (ending == ".urdf") {
    Robot::load(file);
  } else if (ending == ".srdf") {
    Robot::load(goodUrdf, file);
  } else if (ending == ".json") {
    ProblemFile::load(file);
  } else {
    World::load(file);
  }
}

class BadInputs : public ::testing::TestWithParam<BadInput> {};

TEST_P(BadInputs, GiveTheirMessageAndPrintNothing) {
  unsetenv("ROS_PACKAGE_PATH");
  const test::TemporaryFolder folder;
  folder.write("garbage.stl", "what is this");
  folder.write("notes.txt", "a text");
  folder.write("lines.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n");
  folder.write("needle.obj", "v 0 0 0\nv 1 0 0\nv 0 0 0\nf 1 2 3\n");
  const fs::path goodUrdf = folder.write("good.urdf", kGoodUrdf);
  ASSERT_EQ(test::inputError([&] { load(goodUrdf, goodUrdf); }), "");
  const fs::path file = folder.write(GetParam().file, inFolder(GetParam().text, folder.path()));
  ::testing::internal::CaptureStderr();
  ::testing::internal::CaptureStdout();
  const std::string message = test::inputError([&] { load(file, goodUrdf); });
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(message, inFolder(GetParam().message, folder.path()));
}

INSTANTIATE_TEST_SUITE_P(Files, BadInputs, ::testing::ValuesIn(allInputs()),
                         [](const auto& test) { return test.param.name; });

TEST(MissingFiles, AreNamed) {
  const test::TemporaryFolder folder;
  const std::string missing = (folder.path() / "none.urdf").string();
  EXPECT_EQ(test::inputError([&] { Robot::load(missing); }), missing + ": error: file not found");
  const std::string self = folder.path().string();
  EXPECT_EQ(test::inputError([&] { Robot::load(self); }), self + ": error: not a regular file");
  const std::string scene = (folder.path() / "none.yaml").string();
  EXPECT_EQ(test::inputError([&] { World::load(scene); }), scene + ": error: file not found");
  const auto urdf = folder.write("good.urdf", kGoodUrdf);
  const std::string srdf = (folder.path() / "none.srdf").string();
  EXPECT_EQ(test::inputError([&] { Robot::load(urdf, srdf); }), srdf + ": error: file not found");
}

/// Joints `first` to `last`, a line each, of a chain of links that are there.
std::string jointsInARow(int first, int last) {
  std::string text;
  for (int i = first; i <= last; ++i)
    text += "\n<joint name='j" + std::to_string(i) + "' type='fixed'><parent link='l" +
            std::to_string(i - 1) + "'/><child link='l" + std::to_string(i) + "'/></joint>";
  return text;
}

TEST(Joints, AreAtMostSoMany) {
  constexpr int kMost = 5000;
  std::string links;
  for (int i = 0; i <= kMost; ++i) links += "<link name='l" + std::to_string(i) + "'/>";
  const std::string most = "<robot name='r'>" + links + jointsInARow(1, kMost);
  EXPECT_EQ(Robot::parse(most + "</robot>", "r.urdf")->joints().size(), 5000U);
  EXPECT_EQ(test::inputError([&] {
              (void)Robot::parse(most + jointsInARow(kMost + 1, kMost + 1) + "</robot>", "r.urdf");
            }),
            "r.urdf:5002: error: the robot has more than 5000 joints, which are the most that are "
            "read");
}

TEST(PackageMeshes, SayEveryPlaceThatWasTried) {
  const test::TemporaryFolder folder;
  setenv("ROS_PACKAGE_PATH", "/nowhere/ros", 1);
  const auto urdf = folder.write("urdf/r.urdf", shaped("<mesh filename='package://arm/x.stl'/>"));
  LoadOptions options;
  options.packages = {{"arm", "/nowhere/arm"}};
  const std::string message = test::inputError([&] { Robot::load(urdf, {}, options); });
  unsetenv("ROS_PACKAGE_PATH");
  std::string places = "/nowhere/arm/x.stl, " + (folder.path() / "urdf/arm/x.stl").string();
  for (fs::path parent = folder.path();; parent = parent.parent_path()) {
    places += ", " + (parent / "arm/x.stl").string();
    if (parent == parent.parent_path()) break;
  }
  EXPECT_EQ(message,
            urdf.string() +
                ":4: error: mesh 'package://arm/x.stl' of link 'a' not found; looked for " +
                places +
                ", /nowhere/ros/arm/x.stl; --package arm=DIR (LoadOptions::packages) tells where "
                "package 'arm' is");
}

TEST(MissingMeshes, AreAllNamedAtOnceAndNoMoreThanTen) {
  const test::TemporaryFolder folder;
  folder.write("there.obj", test::kCubeObj);
  std::string links = "<robot name='r'>";
  for (int i = 0; i < 13; ++i)
    links += "\n<link name='l" + std::to_string(i) + "'><collision><geometry><mesh filename='" +
             (i == 1 ? "there" : "m" + std::to_string(i)) +
             ".obj'/></geometry></collision></link>" +
             (i == 0 ? ""
                     : "<joint name='j" + std::to_string(i) +
                           "' type='fixed'><parent link='l0'/><child link='l" + std::to_string(i) +
                           "'/></joint>");
  const auto urdf = folder.write("r.urdf", links + "</robot>");
  const std::string place = (folder.path() / "m0.obj").string();
  EXPECT_EQ(test::inputError([&] { Robot::load(urdf); }),
            urdf.string() + ":2: error: mesh 'm0.obj' of link 'l0' not found; looked for " + place +
                "; missing as well: 'm2.obj' (line 4), 'm3.obj' (line 5), 'm4.obj' (line 6), "
                "'m5.obj' (line 7), 'm6.obj' (line 8), 'm7.obj' (line 9), 'm8.obj' (line 10), "
                "'m9.obj' (line 11), 'm10.obj' (line 12) and 2 more");
}

}  // namespace
}  // namespace swept
