# Reads every source once; prints breaches of the include arrows, of the words that core/ may not name and
# of the length of files. Variables: rooms, forbidden (tables beside this file).

function trimmed(text) { sub(/^[ \t]+/, "", text); sub(/[ \t]+$/, "", text); return text }

BEGIN {
  longest_lines = 450
  while ((getline row < rooms) > 0) {
    if (row ~ /^#/ || row !~ /\|/) continue
    split(row, column, "|")
    room = trimmed(column[1])
    may_include[room] = " " trimmed(column[2]) " "
    outside[room] = trimmed(column[3])
  }
  while ((getline row < forbidden) > 0) {
    if (row ~ /^# / || row !~ / \| /) continue
    at = match(row, / \| [^|]*$/)
    word[++words] = trimmed(substr(row, 1, at - 1))
    reason[words] = trimmed(substr(row, at + 3))
  }
}

function breach(what) { print FILENAME ":" FNR ": " what }

# The most specific room of a path, or "" outside the rooms.
function room_of(path,    room, best) {
  best = ""
  for (room in may_include) {
    if (index(path, room "/") == 1 && length(room) > length(best)) best = room
  }
  return best
}

# Whether the room may use a path of ours: some listed room is the path's own room or holds it.
function may_use(room, path,    list, count, i) {
  count = split(trimmed(may_include[room]), list, " ")
  for (i = 1; i <= count; ++i) if (index(path, list[i] "/") == 1) return 1
  return 0
}

function may_use_outside(room, header,    list, count, i, pattern) {
  count = split(outside[room], list, " ")
  for (i = 1; i <= count; ++i) {
    pattern = list[i]
    if (sub(/^cpp:/, "", pattern) && FILENAME !~ /\.cpp$/) continue
    if (header ~ "^" pattern "$") return 1
  }
  return 0
}

# The line without comments and without what stands in quotes; remembers an open /* between lines.
function code_of(line,    result, at, rest) {
  result = ""
  while (line != "") {
    if (in_comment) {
      at = index(line, "*/")
      if (at == 0) return result
      in_comment = 0
      line = substr(line, at + 2)
    } else if (match(line, /\/\/|\/\*|"([^"\\]|\\.)*"|'([^'\\]|\\.)'/)) {
      result = result substr(line, 1, RSTART - 1) " "
      rest = substr(line, RSTART, 2)
      line = substr(line, RSTART + RLENGTH)
      if (rest == "//") return result
      if (rest == "/*") in_comment = 1
    } else {
      return result line
    }
  }
  return result
}

function check_include(line,    header) {
  header = line
  sub(/^[ \t]*#[ \t]*include[ \t]*[<"]/, "", header)
  sub(/[>"].*$/, "", header)
  if (line ~ /include[ \t]*"/) {
    if (header !~ /\//) breach("\"" header "\" is not named from the root of the tree")
    else if (!may_use(room, header)) breach("room " room " may not include \"" header "\"")
  } else if (header ~ /[.\/]/ && !may_use_outside(room, header)) {
    breach("room " room " may not include <" header ">")
  }
}

# A word of core/ that is forbidden: whole words only, so `renew` and `new_height` pass.
function check_words(code,    i) {
  gsub(/=[ \t]*delete/, " ", code)
  for (i = 1; i <= words; ++i) {
    if (code ~ "(^|[^A-Za-z0-9_])(" word[i] ")($|[^A-Za-z0-9_])") breach("core/ names " word[i] ": " reason[i])
  }
}

FNR == 1 {
  room = room_of(FILENAME)
  in_comment = 0
  too_long = 0
}
FNR > longest_lines && !too_long {
  too_long = 1
  breach("longer than " longest_lines " lines: split it by purpose")
}
FILENAME ~ /\.(cpp|hpp|h)$/ && room != "" {
  if ($0 ~ /^[ \t]*#[ \t]*include[ \t]*[<"]/) check_include($0)
  code = $0 ~ /^[ \t]*#[ \t]*include/ ? $0 : code_of($0)
  if (room ~ /^core\//) check_words(code)
  if (code ~ /(^|[^A-Za-z0-9_])(set|new|use)?locale($|[^A-Za-z0-9_])/) {
    breach("names a locale: numbers are written and read the same in every country")
  }
}
