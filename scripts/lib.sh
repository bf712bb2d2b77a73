# Shared by the scripts: steps with their time, messages, and what is installed where. Sourced, never run.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
tools=$root/build/tools
log=$root/build/logs
mkdir -p "$tools" "$log"
export CCACHE_BASEDIR=$root CCACHE_NOHASHDIR=true  # what one checkout compiled, another need not

die() { printf 'voxtet: %s\n' "$*" >&2; exit 1; }

# step NAME COMMAND...: one line with its time; the output goes to a log that is shown when the step fails.
step() {
  local name=$1 start=$SECONDS
  shift
  local file="$log/${name//[^A-Za-z0-9]/-}.log"
  printf '%-44s' "$name ..."
  if "$@" >"$file" 2>&1; then
    printf ' %4d s\n' $((SECONDS - start))
  else
    printf ' failed after %d s\n' $((SECONDS - start))
    tail -n 60 "$file" | cut -c1-400 >&2
    die "step '$name' failed; whole output: ${file#"$root"/}"
  fi
}

as_root() {
  if [ "$(id -u)" = 0 ]; then "$@"
  elif command -v sudo >/dev/null; then sudo "$@"
  else die "need root or sudo for: $*"
  fi
}

# Compile jobs: one for each core, but no more than one for 2 GB of memory, which CGAL and Eigen may take.
jobs() {
  local cores memory
  cores=$(nproc)
  memory=$(awk '/MemTotal/ {print int($2 / 2000000)}' /proc/meminfo)
  [ "$memory" -lt 1 ] && memory=1
  echo $((cores < memory ? cores : memory))
}

# The node to use: the system's where it is recent enough for the tools of the web app, else our own.
use_node() {
  if [ -x "$tools/node/bin/node" ]; then PATH=$tools/node/bin:$PATH; fi
  export PATH
}
