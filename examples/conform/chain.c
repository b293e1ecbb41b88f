/* The chain of robots [Kovács 2011], its published rule, in C99: a program for `tautline conform` that shares no code
   with Tautline. It is the plain recursion of Algorithms 1 to 3, with a flood fill for each candidate. It reads a
   line, plans for the whole team, and writes a line. What robots have learnt is in `blocked` and `cells` alone.

   cc -std=c99 -o chain chain.c && tautline conform RUN -- ./chain */

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 64, WIDE = 2 * MOST + 1, STAY = 4, FAR = 1 << 20 };

typedef struct { int x, y; } Cell;

static const int DX[5] = {1, 0, -1, 0, 0}, DY[5] = {0, 1, 0, -1, 0};
static const char LETTERS[] = "ESWN.";

static int robots;
static Cell cells[MOST], first, last; /* R_1, the base, to R_N; the area */
static char explored[WIDE][WIDE], wall[WIDE][WIDE][4], virtual_[WIDE][WIDE][4];
static int planned[MOST];
static char (*history)[MOST]; /* the steps that were made and not taken back */
static int depth;
static int gained = 1, is_back;

static Cell after(Cell at, int step) { return (Cell){at.x + DX[step], at.y + DY[step]}; }
static int reverse(int step) { return step == STAY ? STAY : (step + 2) % 4; }
static int same(Cell a, Cell b) { return a.x == b.x && a.y == b.y; }
static int inside(Cell c) { return first.x <= c.x && c.x <= last.x && first.y <= c.y && c.y <= last.y; }

/* A mark of cell c, which is kept by its place round the base. */
#define OF(marks, c) (marks)[(c).y - cells[0].y + MOST][(c).x - cells[0].x + MOST]

static int in_safe(Cell a, Cell b) { return abs(a.x - b.x) <= 1 && abs(a.y - b.y) <= 1; }
static int side_by_side(Cell a, Cell b) { return abs(a.x - b.x) + abs(a.y - b.y) <= 1; }
static int in_covered(Cell a, Cell b) { return in_safe(a, b) || abs(a.x - b.x) + abs(a.y - b.y) <= 2; }

static void put(char marks[WIDE][WIDE][4], Cell c, int side)
{
    Cell beyond = after(c, side);
    OF(marks, c)[side] = 1;
    if (inside(beyond))
        OF(marks, beyond)[reverse(side)] = 1;
}

/* Steps from a cell to the nearest unexplored one, equation (4). */
static int distance(Cell from, int avoids_virtual)
{
    static Cell queue[WIDE * WIDE];
    static int steps[WIDE][WIDE];
    int head = 0, tail = 0, side;
    if (!inside(from))
        return FAR;
    memset(steps, 0, sizeof steps);
    queue[tail++] = from;
    OF(steps, from) = 1;
    while (head < tail) {
        Cell c = queue[head++];
        if (!OF(explored, c))
            return OF(steps, c) - 1;
        for (side = 0; side < 4; side++) {
            Cell next = after(c, side);
            if (OF(wall, c)[side] || (avoids_virtual && OF(virtual_, c)[side]) || OF(steps, next))
                continue;
            OF(steps, next) = OF(steps, c) + 1;
            queue[tail++] = next;
        }
    }
    return FAR;
}

/* Whether another robot, which has planned already, is to be in this cell. */
static int is_taken(int robot, Cell to)
{
    int ahead;
    for (ahead = robot + 1; ahead < robots; ahead++)
        if (same(after(cells[ahead], planned[ahead]), to))
            return !same(to, cells[0]);
    return 0;
}

/* Algorithm 1: whether R_i, and all behind it, can follow. */
static int follow(int robot)
{
    Cell at = cells[robot], ahead = after(cells[robot + 1], planned[robot + 1]);
    int list[5], keys[5], count = 0, step, place;
    if (robot == 0) {
        planned[0] = STAY;
        return in_safe(ahead, at);
    }
    for (step = 0; step <= STAY; step++) {
        Cell to = after(at, step);
        int key;
        if ((step != STAY && OF(wall, at)[step]) || is_taken(robot, to) || !in_covered(cells[robot - 1], to) ||
            !in_safe(ahead, to))
            continue;
        /* To stay within P_high, then P_high, then the nearest to the frontier, then in direction order. */
        key = (side_by_side(ahead, to) ? step != STAY : 2) * 2 * FAR + distance(to, 0);
        for (place = count++; place > 0 && keys[place - 1] > key; place--) {
            keys[place] = keys[place - 1];
            list[place] = list[place - 1];
        }
        keys[place] = key;
        list[place] = step;
    }
    for (place = 0; place < count; place++) {
        planned[robot] = list[place];
        if (follow(robot - 1))
            return 1;
    }
    return 0;
}

/* Algorithm 2: the first candidate of the leader that the others can follow. */
static int lead(void)
{
    int leader = robots - 1, list[4], near[4], out[4], count = 0, side, place;
    Cell at = cells[leader], base = cells[0];
    for (side = 0; side < 4; side++) {
        int steps, outward = DX[side] * (at.x - base.x) + DY[side] * (at.y - base.y);
        if (OF(wall, at)[side] || OF(virtual_, at)[side] || (steps = distance(after(at, side), 1)) == FAR)
            continue;
        for (place = count++; place > 0; place--) {
            if (near[place - 1] < steps || (near[place - 1] == steps && out[place - 1] >= outward))
                break;
            near[place] = near[place - 1];
            out[place] = out[place - 1];
            list[place] = list[place - 1];
        }
        near[place] = steps;
        out[place] = outward;
        list[place] = side;
    }
    for (place = 0; place < count; place++)
        if (!in_covered(cells[leader - 1], after(at, list[place])))
            put(virtual_, at, list[place]);
    for (place = 0; place < count; place++) {
        side = list[place];
        planned[leader] = in_covered(cells[leader - 1], after(at, side)) ? side : STAY;
        if (follow(leader - 1))
            return 1;
        put(virtual_, at, side);
    }
    return 0;
}

/* Plans a team move; 0 if nothing is left to do. */
static int plan(void)
{
    int is_fresh, robot, x, y, is_left = 0;
    for (y = first.y; y <= last.y; y++)
        for (x = first.x; x <= last.x; x++)
            is_left |= !OF(explored, ((Cell){x, y}));
    for (is_fresh = 0; is_left && is_fresh < 2; is_fresh++) {
        is_back = 0;
        if (lead())
            return 1;
        if (depth > 0) {
            is_back = 1;
            for (robot = 0; robot < robots; robot++)
                planned[robot] = reverse(history[depth - 1][robot]);
            return 1;
        }
        if (!gained)
            return 0;
        gained = 0;
        memset(virtual_, 0, sizeof virtual_);
    }
    return 0;
}

/* Learns how the planned team move has come out, of a line that tells it. */
static void learn(const char *line)
{
    const char *text = strstr(line, "\"blocked\":[");
    int robot;
    text = text ? text + 11 : "]";
    if (is_back)
        depth--;
    while (*text && *text != ']') {
        robot = (int)strtol(text, (char **)&text, 10) - 1;
        if (robot < 0 || robot >= robots || planned[robot] == STAY)
            exit(2);
        gained |= !OF(wall, cells[robot])[planned[robot]];
        put(wall, cells[robot], planned[robot]);
        planned[robot] = STAY;
        text += *text == ',';
    }
    if (!is_back) {
        history = realloc(history, (size_t)(depth + 1) * sizeof *history);
        if (!history)
            exit(2);
        for (robot = 0; robot < robots; robot++)
            history[depth][robot] = (char)planned[robot];
        depth++;
    }
    for (robot = 0; robot < robots; robot++) {
        Cell to = cells[robot] = after(cells[robot], planned[robot]);
        gained |= !OF(explored, to);
        OF(explored, to) = 1;
    }
}

static int number(const char *line, const char *key)
{
    const char *text = strstr(line, key);
    return text ? atoi(text + strlen(key)) : -1;
}

/* Learns of the run that begins. */
static void begin(const char *line)
{
    const char *size = strstr(line, "\"size\":["), *start = strstr(line, "\"starts\":[[");
    int wide, high, robot, x, y, side;
    robots = number(line, "\"robots\":");
    if (!strstr(line, "\"scheme\":\"chain\",\"rule\":\"published\"") ||
        robots < 2 || robots > MOST || !size || !start ||
        sscanf(size, "\"size\":[%d,%d]", &wide, &high) != 2 ||
        sscanf(start, "\"starts\":[[%d,%d]", &cells[0].x, &cells[0].y) != 2) {
        fprintf(stderr, "chain: this is no published chain of 2 to %d robots\n", MOST);
        exit(2);
    }
    for (robot = 1; robot < robots; robot++)
        cells[robot] = cells[0];
    first.x = cells[0].x < robots ? 0 : cells[0].x - robots + 1;
    first.y = cells[0].y < robots ? 0 : cells[0].y - robots + 1;
    last.x = cells[0].x + robots > wide ? wide - 1 : cells[0].x + robots - 1;
    last.y = cells[0].y + robots > high ? high - 1 : cells[0].y + robots - 1;
    for (y = first.y; y <= last.y; y++)
        for (x = first.x; x <= last.x; x++)
            for (side = 0; side < 4; side++)
                if (!inside(after((Cell){x, y}, side)))
                    put(wall, (Cell){x, y}, side);
    OF(explored, cells[0]) = 1;
}

int main(void)
{
    static char line[1 << 16];
    int robot;
    while (fgets(line, sizeof line, stdin) && !strstr(line, "\"end\":")) {
        int step = number(line, "\"step\":");
        if (step < 0) {
            begin(line);
            continue;
        }
        if (step > 1)
            learn(line);
        if (plan()) {
            printf("{\"tried\":\"");
            for (robot = 0; robot < robots; robot++)
                putchar(LETTERS[planned[robot]]);
            printf("\",\"kind\":\"%s\"}\n", is_back ? "backtrack" : "advance");
        } else {
            puts("{\"done\":true}");
        }
        fflush(stdout);
    }
    return 0;
}
