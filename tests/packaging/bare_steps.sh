# SPDX-License-Identifier: BSD-3-Clause
# Sourced by bare_debian.sh: what each step does, `step_NAME`, in this order. Each system is a copy of the
# bare one: `build` has the clone, the others nothing of it but what is copied there.
steps=(debian demo tests install programs sources core debs core_deb swept_deb remove)

clone=/root/swept
prefix=/opt/swept
arm=/root/models/robots/rook7/rook7.urdf
slot=/root/models/scenes/narrow_slot.yaml

step_says() {
  case "$1" in
    debian) echo "a bare Debian ${releases[$suite]} (\`debootstrap --variant=minbase\`), and a clone in it" ;;
    demo) echo "\`./planners_demo/demo.sh\`: packages, the program, a plan" ;;
    tests) echo "\`./tests/run.sh\`: $(tail -n 1 "$folder/logs/tests.log")" ;;
    install) echo "\`cmake --install build/release --prefix $prefix\`" ;;
    programs) echo "programs against that by CMake and by pkg-config, where the clone is hidden" ;;
    sources) echo "a program with the sources in its own build, by \`FetchContent\`" ;;
    core) echo "a second bare Debian: a program against what is installed, with the core's three packages alone" ;;
    debs) echo "the \`.deb\` packages; their relations and content; no errors of lintian" ;;
    core_deb) echo "a third: \`apt install\` of the core's packages, a program" ;;
    swept_deb) echo "a fourth: \`apt install\` of the program's packages, \`info\`, \`plan\`, \`verify\`" ;;
    remove) echo "\`dpkg -r\` there leaves nothing" ;;
  esac
}

# A system of its own: copy_of_bare SYSTEM.
copy_of_bare() {
  rm -rf --one-file-system "${folder:?}/$1"
  cp -a "$folder/bare" "$folder/$1"
}

# Installs packages, or .deb files of the system: get SYSTEM PACKAGE...
get() {
  inside "$1" apt-get update -q
  inside "$1" apt-get install -q -y --no-install-recommends "${@:2}"
}

in_clone() { inside build env -C "$clone" "$@"; }
without_clone() { hidden="$clone" inside build "$@"; }

# Puts folders or files of the clone into a system's /root: copy_into SYSTEM PATH...
copy_into() {
  local path
  for path in "${@:2}"; do cp -r "$folder/build$clone/"$path "$folder/$1/root/"; done
}

step_debian() {
  rm -rf --one-file-system "$folder/bare"
  debootstrap --variant=minbase "$suite" "$folder/bare" ${mirror:+"$mirror"}
  # As installers and images have it; debootstrap alone leaves nobody who knows localhost.
  printf '127.0.0.1\tlocalhost\n::1\tlocalhost\n' >"$folder/bare/etc/hosts"
  copy_of_bare build
  git clone -q --no-hardlinks "$root" "$folder/build$clone"
}

step_demo() {
  in_clone ./planners_demo/demo.sh
  in_clone test -s build/demo/path.json -a -s build/demo/page.html
}

step_tests() { in_clone ./tests/run.sh; }

step_install() { in_clone cmake --install build/release --prefix "$prefix"; }

step_programs() {
  copy_into build tests/packaging/core tests/packaging/full models
  local project module words
  for project in core full; do
    without_clone cmake -G Ninja -S "/root/$project" -B "/root/$project/build" -D CMAKE_PREFIX_PATH="$prefix"
    without_clone cmake --build "/root/$project/build"
  done
  without_clone /root/core/build/distance
  without_clone /root/full/build/motion "$arm" "$slot"
  for module in core/distance:swept-core full/motion:swept-ompl-bridge; do
    words="$(without_clone env PKG_CONFIG_PATH="$prefix/lib/pkgconfig" \
      pkg-config --static --cflags --libs "${module#*:}")"
    # shellcheck disable=SC2086
    without_clone c++ -std=c++20 "/root/${module%:*}.cpp" $words -o "/root/${module%:*}"
  done
  without_clone /root/core/distance
  without_clone /root/full/motion "$arm" "$slot"
  without_clone "$prefix/bin/swept" plan "$arm" home ready --group arm --scene "$slot"
}

step_sources() { in_clone tests/packaging/run.sh build/release whole_tree; }

step_core() {
  copy_of_bare core
  copy_into core tests/packaging/core
  cp -r "$folder/build$prefix" "$folder/core$prefix"
  get core g++ cmake make libeigen3-dev libccd-dev
  core_program core -D CMAKE_PREFIX_PATH="$prefix"
}

# core_program SYSTEM [OPTION]...
core_program() {
  inside "$1" cmake -S /root/core -B /root/core/build "${@:2}"
  inside "$1" cmake --build /root/core/build
  inside "$1" /root/core/build/distance
}

step_debs() {
  get build dpkg-dev file lintian
  in_clone cmake --preset deb
  in_clone cmake --build --preset deb --target package
  in_clone tests/packaging/debs.sh
}

step_core_deb() {
  copy_of_bare core_deb
  copy_into core_deb tests/packaging/core 'build/deb/libswept-core*.deb'
  get core_deb g++ cmake make
  inside core_deb bash -c 'apt-get install -q -y --no-install-recommends /root/libswept-core*.deb'
  if inside core_deb dpkg-query -W -f '${Package}\n' | grep -E 'ompl|assimp|urdf|yaml|tbb|boost'; then
    echo "the core's packages brought these"
    return 1
  fi
  core_program core_deb
}

step_swept_deb() {
  copy_of_bare swept_deb
  copy_into swept_deb models 'build/deb/libswept-*0.1_*.deb' 'build/deb/swept_*.deb'
  inside swept_deb apt-get update -q
  inside swept_deb bash -c 'apt-get install -q -y --no-install-recommends /root/*.deb'
  inside swept_deb swept --version
  inside swept_deb swept info "$arm"
  inside swept_deb swept plan "$arm" home ready --group arm --scene "$slot" -o /root/path.json
  inside swept_deb swept verify /root/path.json
  inside swept_deb gzip -t /usr/share/man/man1/swept.1.gz
}

step_remove() {
  local packages left given=("$folder"/swept_deb/root/*.deb)
  mapfile -t packages < <(inside swept_deb dpkg-query -W -f '${Package}\n' '*swept*')
  ((${#packages[@]} == ${#given[@]}))
  local files="$folder/logs/installed_files"
  inside swept_deb dpkg -L "${packages[@]}" | grep -F swept | sort -u >"$files"
  inside swept_deb dpkg -r "${packages[@]}"
  while read -r left; do
    if [[ -e "$folder/swept_deb$left" || -L "$folder/swept_deb$left" ]]; then
      echo "$left is still there"
      return 1
    fi
  done <"$files"
  if find "$folder/swept_deb" -xdev -mindepth 1 -name '*swept*' -not -path "$folder/swept_deb/root/*" | grep .; then
    echo "these are still there"
    return 1
  fi
  if inside swept_deb ldconfig -p | grep swept; then return 1; fi
  if inside swept_deb dpkg-query -W '*swept*'; then return 1; fi
}
