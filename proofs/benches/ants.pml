/* Ants on an open floor: whoever is next goes to the neighbour that was entered least often, ties in the order of the
   compass, until every cell was entered. The same model is searched in benches/states.rs. */

#define WIDTH 5
#define CELLS 20
#define ANTS 3

byte crossings[CELLS];
byte at[ANTS];
byte unexplored = CELLS - 1;
hidden byte here;
hidden byte best;

inline look(cell) {
    if
    :: best == CELLS || crossings[cell] < crossings[best] -> best = cell
    :: else
    fi
}

inline step(ant) {
    d_step {
        unexplored > 0;
        here = at[ant];
        best = CELLS;
        if :: here >= WIDTH -> look(here - WIDTH) :: else fi;
        if :: here % WIDTH < WIDTH - 1 -> look(here + 1) :: else fi;
        if :: here < CELLS - WIDTH -> look(here + WIDTH) :: else fi;
        if :: here % WIDTH > 0 -> look(here - 1) :: else fi;
        if :: crossings[best] == 0 -> unexplored-- :: else fi;
        crossings[best]++;
        at[ant] = best
    }
}

init {
    crossings[0] = ANTS;
end:
    do
    :: step(0)
    :: step(1)
    :: step(2)
    od
}
