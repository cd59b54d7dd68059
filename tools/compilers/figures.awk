# Prints the figures of a piece of hardware from a report of layer.cpp, and those that violate a bound. Fails if any does.
#
#   awk -F '\t' -v hardware=NAME -v kernels="NAME..." -f figures.awk bounds.txt REPORT

BEGIN {
    # The names of statistics in RADV, ANV and NVK.
    figures = split("lanes registers spilled scratch shared waves code", order, " ")
    terms["lanes"] = "Subgroup size"
    terms["registers"] = "VGPRs|Number of GPRs"
    terms["spilled"] = "Spilled SGPRs|Spilled VGPRs|Spill Count|Fill Count"
    terms["scratch"] = "Scratch size|Scratch Memory Size|SLM Size"
    terms["shared"] = "LDS size|Workgroup Memory Size"
    terms["waves"] = "Subgroups per SIMD"
    terms["code"] = "Code size|Code Size"
}

FNR == NR {
    if ($0 !~ /^#/ && split($0, word, / +/) == 5 && word[1] == hardware) {
        bounds++
        pattern[bounds] = word[2]
        gsub(/\*/, ".*", pattern[bounds])
        figure[bounds] = word[3]
        relation[bounds] = word[4]
        bound[bounds] = word[5]
    }
    next
}

$1 == "frame" {
    frame = $2
    frames[++frame_count] = frame
    next
}

$1 == "refused" {
    print "   refused: " $2
    failed = 1
    next
}

$1 == "commands" {
    value[frame, "dispatches"] += $2
    value[frame, "barriers"] += $3
    value[frame, "transfers"] += $4
    next
}

# A part of a pipeline; the parts of a graphics pipeline come one after the other.
{
    parts = split($2, stage, "+")
    number = seen[frame, $2, $3]++ % parts
    name = stage[number + 1]
    compiled[name] = 1
    for (f = 1; f <= figures; f++) {
        sum = 0
        reported = 0
        words = split(terms[order[f]], term, "|")
        for (w = 1; w <= words; w++)
            for (i = 5; i <= NF; i++)
                if (index($i, term[w] "=") == 1) {
                    sum += substr($i, length(term[w]) + 2)
                    reported = 1
                }
        if (reported) worst(name, order[f], sum)
    }
    if (number == 0) {
        worst(name, "compile", $4)
        value[frame, "compile"] += $4
    }
}

function worst(name, key, number) {
    if (!((name, key) in value) || (key == "waves" ? number < value[name, key] : number > value[name, key])) value[name, key] = number
}

function cell(name, key) { return (name, key) in value ? sprintf("%.0f", value[name, key]) : "-" }

function check(name,    b) {
    for (b = 1; b <= bounds; b++) {
        if (name !~ "^" pattern[b] "$" || !((name, figure[b]) in value)) continue
        used[b] = 1
        if (relation[b] == ">=" ? value[name, figure[b]] >= bound[b] + 0 : value[name, figure[b]] <= bound[b] + 0) continue
        printf "   past its bound: %s: %s %.0f, should be %s %s\n", name, figure[b], value[name, figure[b]], relation[b], bound[b]
        failed = 1
    }
}

END {
    head = "   %-26s %5s %9s %7s %7s %6s %5s %6s %5s\n"
    printf head, "kernel", "lanes", "registers", "spilled", "scratch", "shared", "waves", "code", "ms"
    total = split(kernels, all, " ")
    for (k = 1; k <= total; k++) {
        name = all[k]
        if (compiled[name])
            printf head, name, cell(name, "lanes"), cell(name, "registers"), cell(name, "spilled"), cell(name, "scratch"), \
                cell(name, "shared"), cell(name, "waves"), cell(name, "code"), cell(name, "compile")
        else
            absent = absent " " name
    }
    print "   in no frame:" absent
    head = "   %-26s %10s %9s %10s %6s\n"
    printf head, "frame", "dispatches", "barriers", "transfers", "ms"
    for (f = 1; f <= frame_count; f++) {
        name = frames[f]
        printf head, name, cell(name, "dispatches"), cell(name, "barriers"), cell(name, "transfers"), cell(name, "compile")
    }
    for (k = 1; k <= total; k++) check(all[k])
    for (f = 1; f <= frame_count; f++) check(frames[f])
    for (b = 1; b <= bounds; b++) {
        if (used[b]) continue
        print "   nothing has this bound: " hardware " " pattern[b] " " figure[b]
        failed = 1
    }
    exit failed
}
