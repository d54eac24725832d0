# What `boot` and `boot-user` have in common: a folder that both the machine that is started and this one see. `guest`
# finds the command in it and leaves what came of it.

open_share() {  # KERNEL_FOLDER COMMAND [ARGUMENT...]; sets kernel and share
  kernel=$(realpath "$1")
  shift
  share=$(mktemp -d "$kernel/share.XXXXXX")
  trap 'rm -rf "$share"' EXIT
  pwd -P >"$share/directory"
  echo "$kernel" >"$share/kernel"
  echo "${RIG_NEED:-}" >"$share/need"  # where it says screen, there is a graphics card as well
  export -p >"$share/environment"
  printf '%q ' "$@" >"$share/command"
}

end_with_result() {  # STATUS of what ran the machine; ends with that of the command
  [ ! -e "$share/output" ] || cat "$share/output"
  [ ! -s "$share/status" ] || exit "$(<"$share/status")"
  [ "$1" -ne 124 ] || { echo "boot: stopped after ${RIG_TIMEOUT:-300} s" >&2; exit 124; }
  tail -q -n 20 "$share/emulator" "$share/console" "$share/guest" 2>/dev/null >&2 || true
  echo "boot: the machine ended without a result (status $1)" >&2
  exit 125
}
