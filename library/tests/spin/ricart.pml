/* Ricart and Agrawala's mutual exclusion: each of N nodes enters once; messages arrive in any order, and at most LOSSES of
   them are lost. The states are those of ricart.rs. */

#ifndef LOSSES
#define LOSSES 0
#endif
#define N 3
#define AT(from, to) (from) * N + (to)

mtype = { idle, wants, inside, done };

mtype phase[N] = idle;
/* The number of a node's request, the largest number that it knows, who has replied, and who waits. */
byte own[N];
byte known[N];
byte replies[N];
byte waiting[N];
/* Under way: the number of a request, and whether there is a reply. */
byte request[N * N];
bool reply[N * N];
byte losses = LOSSES;
hidden byte other;

inline asks(me) {
    d_step {
        phase[me] == idle;
        phase[me] = wants;
        known[me]++;
        own[me] = known[me];
        for (other : 0 .. N - 1) {
            if :: other != me -> request[AT(me, other)] = own[me] :: else fi
        }
    }
}

inline enters(me) {
    d_step {
        phase[me] == wants && (replies[me] | (1 << me)) == (1 << N) - 1;
        phase[me] = inside
    }
}

inline leaves(me) {
    d_step {
        phase[me] == inside;
        phase[me] = done;
        for (other : 0 .. N - 1) {
            if :: waiting[me] & (1 << other) -> reply[AT(me, other)] = true :: else fi
        }
        replies[me] = 0;
        waiting[me] = 0
    }
}

inline hears(from, to) {
    d_step {
        request[AT(from, to)] != 0;
        if :: request[AT(from, to)] > known[to] -> known[to] = request[AT(from, to)] :: else fi;
        if
        :: phase[to] == inside || phase[to] == wants && (own[to] < request[AT(from, to)] ||
           own[to] == request[AT(from, to)] && to < from) -> waiting[to] = waiting[to] | (1 << from)
        :: else -> reply[AT(to, from)] = true
        fi;
        request[AT(from, to)] = 0
    }
}

inline hears_reply(from, to) {
    d_step {
        reply[AT(from, to)];
        reply[AT(from, to)] = false;
        replies[to] = replies[to] | (1 << from)
    }
}

inline loses(from, to) {
    d_step { losses > 0 && request[AT(from, to)] != 0; request[AT(from, to)] = 0; losses-- }
}

inline loses_reply(from, to) {
    d_step { losses > 0 && reply[AT(from, to)]; reply[AT(from, to)] = false; losses-- }
}

init {
end:
    do
    :: asks(0)
    :: asks(1)
    :: asks(2)
    :: enters(0)
    :: enters(1)
    :: enters(2)
    :: leaves(0)
    :: leaves(1)
    :: leaves(2)
    :: hears(0, 1)
    :: hears(0, 2)
    :: hears(1, 0)
    :: hears(1, 2)
    :: hears(2, 0)
    :: hears(2, 1)
    :: hears_reply(0, 1)
    :: hears_reply(0, 2)
    :: hears_reply(1, 0)
    :: hears_reply(1, 2)
    :: hears_reply(2, 0)
    :: hears_reply(2, 1)
    :: loses(0, 1)
    :: loses(0, 2)
    :: loses(1, 0)
    :: loses(1, 2)
    :: loses(2, 0)
    :: loses(2, 1)
    :: loses_reply(0, 1)
    :: loses_reply(0, 2)
    :: loses_reply(1, 0)
    :: loses_reply(1, 2)
    :: loses_reply(2, 0)
    :: loses_reply(2, 1)
    od
}
