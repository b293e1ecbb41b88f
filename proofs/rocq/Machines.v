(** The robot, the WFR and the path node of MRC as the kernel has them: kernel/src/mrc/robot.rs, wfr.rs and
    relay.rs, condition for condition, with hop counts, parents, room and repeats.

    Each is a function from what it is and what it hears to what it is then and what it sends. Whatever a network
    does is a list of what a machine hears, so that a sentence about every such list is one about every number of
    robots and WFRs. MachinesTie.v compares the functions with the kernel's answers. Hop counts and epochs have no
    upper end. *)
From Coq Require Import List Bool Arith.
Import ListNotations.

(** The conditions of kernel/src/mrc/rule.rs, and how often a message without an answer is repeated. *)
Record rule := {
  nearest_call : bool; nearest_robot : bool; least_identity : bool;
  window : bool; choice_stands : bool; answers_again : bool; epochs : bool; consent : bool;
  still_asks : bool; renewal : bool; repetition : bool; repeats : nat;
}.

Definition PUBLISHED : rule := Build_rule true true true false false false false false false false false 0.
Definition REPAIRED : rule := Build_rule true true true true true true true true true true true 1.
Definition without_NearestCall : rule := Build_rule false true true true true true true true true true true 1.
Definition without_NearestRobot : rule := Build_rule true false true true true true true true true true true 1.
Definition without_LeastIdentity : rule := Build_rule true true false true true true true true true true true 1.
Definition without_ChoiceStands : rule := Build_rule true true true true false true true true true true true 1.
Definition without_AnswersAgain : rule := Build_rule true true true true true false true true true true true 1.
Definition without_Epochs : rule := Build_rule true true true true true true false true true true true 1.
Definition without_Repetition : rule := Build_rule true true true true true true true true true true false 1.

(** The repaired rule with so many repeats. *)
Definition repeating (n : nat) : rule := Build_rule true true true true true true true true true true true n.

Definition repeats_of (rl : rule) : nat := if repetition rl then repeats rl else 0.

(** What comes after a list of inputs. *)
Definition after {S I O : Type} (step : S -> I -> S * O) (x : S) (l : list I) : S :=
  fold_left (fun x i => fst (step x i)) l x.

(** No more than [room] things are such. *)
Definition at_most {A : Type} (room : nat) (such : A -> Prop) : Prop :=
  forall l, NoDup l -> (forall a, In a l -> such a) -> length l <= room.

(** ** A WFR *)

(** A MOVE's hop count MHC, and its robot MID. *)
Record bid := { mhc : nat; mid : nat }.

Inductive phase :=
| Idle
| Collecting (best : option bid)
| Offered (choice : bid) (repeats_left : nat)
| CountsOn (choice : bid)
| Rescued.

(** The number of its call, how far it is, and who has asked. *)
Record wfr := { call : nat; stage : phase; asked : list nat }.

Inductive word := Move (h : nat) | Accept | Decline.

(** [Says w e r word]: robot [r] says so of the call [e] of WFR [w]. *)
Inductive wfr_input := Raised | Says (w e r : nat) (says : word) | Expires | Reached.

(** A NOTICE of its call [e], or a RESB: for its call [e] it tells robot [to] whom it has chosen. *)
Inductive mail := Calls (e : nat) | Resb (e to : nat) (chosen : option nat).

Section Wfr.
  (** Its rule, its number, and for how many robots that have asked it has room. *)
  Variables (rl : rule) (me room : nat).

  Definition fresh_wfr : wfr := {| call := 1; stage := Idle; asked := [] |}.

  (** Whether the second bid is better than the first. *)
  Definition is_better (first second : bid) : bool :=
    if nearest_robot rl && negb (mhc first =? mhc second) then mhc second <? mhc first
    else least_identity rl && (mid second <? mid first).
  Definition better (first second : bid) : bid := if is_better first second then second else first.

  Definition at_phase (x : wfr) (p : phase) : wfr := {| call := call x; stage := p; asked := asked x |}.

  Definition remembers (x : wfr) (r : nat) : wfr :=
    if existsb (Nat.eqb r) (asked x) || (room <=? length (asked x)) then x
    else {| call := call x; stage := stage x; asked := asked x ++ [r] |}.

  Definition calls (e : nat) : wfr * list mail := ({| call := e; stage := Collecting None; asked := [] |}, [Calls e]).

  Definition tells_all (x : wfr) (c : bid) : list mail := map (fun r => Resb (call x) r (Some (mid c))) (asked x).

  Definition chooses (x : wfr) (c : bid) : wfr * list mail :=
    (at_phase x (if consent rl then Offered c (repeats_of rl) else CountsOn c), tells_all x c).

  Definition answers (x : wfr) (r : nat) (c : option nat) : list mail :=
    if answers_again rl then [Resb (call x) r c] else [].

  Definition hears_move (x : wfr) (b : bid) : wfr * list mail :=
    match stage x with
    | Idle => (x, [])
    | Collecting best =>
        let y := remembers x (mid b) in
        let best := match best with Some first => better first b | None => b end in
        if window rl then (at_phase y (Collecting (Some best)), []) else chooses y best
    | Offered c _ | CountsOn c =>
        if choice_stands rl then (x, answers x (mid b) (Some (mid c)))
        else
          let y := remembers x (mid b) in
          if mid (better c b) =? mid c then (y, tells_all y c) else chooses y (better c b)
    | Rescued => (x, answers x (mid b) None)
    end.

  Definition wfr_step (x : wfr) (i : wfr_input) : wfr * list mail :=
    match i with
    | Raised =>
        match stage x with
        | Idle => calls (call x)
        | Rescued => calls (S (call x))
        | Collecting _ | Offered _ _ | CountsOn _ => (x, [])
        end
    | Says w e r says =>
        if (w =? me) && ((e =? call x) || negb (epochs rl)) then
          match says, stage x with
          | Move h, _ => hears_move x {| mhc := h; mid := r |}
          | Accept, Offered c _ => if mid c =? r then (at_phase x (CountsOn c), []) else (x, [])
          | Decline, Offered c _ => if (mid c =? r) && renewal rl then calls (S (call x)) else (x, [])
          | _, _ => (x, [])
          end
        else (x, [])
    | Expires =>
        match stage x with
        | Collecting (Some best) => if window rl then chooses x best else (x, [])
        | Collecting None => if window rl && renewal rl then calls (S (call x)) else (x, [])
        | Offered c (S k) => (at_phase x (Offered c k), [Resb (call x) (mid c) (Some (mid c))])
        | Offered _ 0 | CountsOn _ => if renewal rl then calls (S (call x)) else (x, [])
        | Idle | Rescued => (x, [])
        end
    | Reached =>
        match stage x with
        | Idle | Rescued => (x, [])
        | Collecting _ | Offered _ _ | CountsOn _ => (at_phase x Rescued, [])
        end
    end.
End Wfr.

(** ** A robot *)

(** A record of T_REQ: a WFR, its newest call, the SBit, the robot's hops, and its parent. *)
Record request := { about : nat; epoch : nat; served : bool; hops : nat; parent : nat }.

Inductive task := Free | Asking (w e repeats_left : nat) | Leased (w e : nat).

Record robot := { requests : list request; doing : task }.

(** [Notice w e h s]: node [s], which is [h] hops from WFR [w], tells of its call [e]. [Tells w e to c]: a RESB. *)
Inductive robot_input :=
| Notice (w e h s : nat)
| Tells (w e to : nat) (chosen : option nat)
| Waited
| Arrives
| Lapses (w e : nat).

(** What a robot says to a WFR, by way of its parent PID. *)
Record upward := { to_wfr : nat; of_call : nat; says : word; pid : nat }.

Definition is_about (w : nat) (q : request) : bool := about q =? w.
Definition record_of (x : robot) (w : nat) : option request := find (is_about w) (requests x).

Section Robot.
  (** Its rule, its identity, and for how many WFRs it has room. *)
  Variables (rl : rule) (me room : nat).

  Definition fresh_robot : robot := {| requests := []; doing := Free |}.

  Definition change (w : nat) (f : request -> request) (l : list request) : list request :=
    map (fun q => if is_about w q then f q else q) l.
  Definition set_bit (q : request) : request :=
    {| about := about q; epoch := epoch q; served := true; hops := hops q; parent := parent q |}.
  Definition serve (w : nat) (l : list request) : list request := change w set_bit l.

  (** Whether the second call is nearer than the first. *)
  Definition is_nearer (first second : request) : bool :=
    if nearest_call rl && negb (hops first =? hops second) then hops second <? hops first
    else least_identity rl && (about second <? about first).

  Definition nearer (best : option request) (q : request) : option request :=
    match best with Some first => if is_nearer first q then Some q else best | None => Some q end.

  (** The nearest of the calls whose SBit is clear. *)
  Definition nearest (l : list request) : option request :=
    fold_left nearer (filter (fun q => negb (served q)) l) None.

  Definition bids (q : request) : upward :=
    {| to_wfr := about q; of_call := epoch q; says := Move (hops q); pid := parent q |}.

  (** A free robot sends MOVE for the nearest call that is not served. *)
  Definition asks (x : robot) : robot * option upward :=
    match doing x, nearest (requests x) with
    | Free, Some q =>
        ({| requests := requests x; doing := Asking (about q) (epoch q) (repeats_of rl) |}, Some (bids q))
    | _, _ => (x, None)
    end.

  Definition is_own (t : task) (w : nat) : bool :=
    match t with Free => false | Asking v _ _ | Leased v _ => v =? w end.

  (** [q] in the place of the first record that is served, and not the one of the robot's own WFR. *)
  Fixpoint gives_way (own : nat -> bool) (q : request) (l : list request) : list request :=
    match l with
    | [] => []
    | p :: l => if served p && negb (own (about p)) then q :: l else p :: gives_way own q l
    end.

  Definition adds (x : robot) (q : request) : list request :=
    if length (requests x) <? room then requests x ++ [q] else gives_way (is_own (doing x)) q (requests x).

  (** What a NOTICE makes of its record of the WFR. *)
  Definition noted (q heard : request) : request :=
    if epochs rl && (epoch q <? epoch heard) then heard
    else if epochs rl && negb (epoch q =? epoch heard) then q
    else
      let closer := hops heard <? hops q in
      {| about := about q; epoch := max (epoch q) (epoch heard); served := served q;
         hops := if closer then hops heard else hops q; parent := if closer then parent heard else parent q |}.

  Definition notes (x : robot) (heard : request) : robot :=
    match record_of x (about heard) with
    | None => {| requests := adds x heard; doing := doing x |}
    | Some q =>
        {| requests := change (about heard) (fun q => noted q heard) (requests x);
           doing := if epochs rl && (epoch q <? epoch heard) && is_own (doing x) (about heard) then Free
                    else doing x |}
    end.

  Definition heeds (x : robot) (w e : nat) (chosen : option nat) : robot * option upward :=
    match record_of x w with
    | None => (x, None)
    | Some q =>
        if epochs rl && negb (epoch q =? e) then (x, None)
        else
          let l := serve w (requests x) in
          let asking := match doing x with Asking v _ _ => v =? w | _ => false end in
          let leased := match doing x with Leased v _ => v =? w | _ => false end in
          let under_way := match doing x with Leased _ _ => true | _ => false end in
          if match chosen with Some c => c =? me | None => false end then
            let takes := asking || (negb under_way && negb (still_asks rl)) || negb (consent rl) in
            ({| requests := l; doing := if takes then Leased w e else doing x |},
             if consent rl then
               Some {| to_wfr := w; of_call := e; says := if takes || leased then Accept else Decline;
                 pid := parent q |}
             else None)
          else asks {| requests := l; doing := if asking || leased && negb (consent rl) then Free else doing x |}
    end.

  Definition robot_step (x : robot) (i : robot_input) : robot * option upward :=
    match i with
    | Notice w e h s => asks (notes x {| about := w; epoch := e; served := false; hops := S h; parent := s |})
    | Tells w e to c => if to =? me then heeds x w e c else (x, None)
    | Waited =>
        match doing x with
        | Asking w e (S k) =>
            if repetition rl then
              ({| requests := requests x; doing := Asking w e k |}, option_map bids (record_of x w))
            else (x, None)
        | Asking w e 0 =>
            if repetition rl then asks {| requests := serve w (requests x); doing := Free |} else (x, None)
        | Free | Leased _ _ => (x, None)
        end
    | Arrives =>
        match doing x with
        | Leased _ _ => asks {| requests := requests x; doing := Free |}
        | Free | Asking _ _ _ => asks x
        end
    | Lapses w e =>
        match doing x with
        | Leased v f => if (v =? w) && (f =? e) then asks {| requests := requests x; doing := Free |} else (x, None)
        | Free | Asking _ _ _ => (x, None)
        end
    end.
End Robot.

(** ** A path node *)

(** Who is one hop away. *)
Inductive hop := Node (n : nat) | Robot (r : nat).

(** A way back: to WFR [way_wfr], for its call [way_call], robot [way_robot] came from there. *)
Record way := { way_wfr : nat; way_call : nat; way_robot : nat; came_from : hop }.

(** Robot [sender]'s message comes from [from]; [own] is the node's own parent in the tree of the call. *)
Record passing := { message : upward; sender : nat; from : hop; own : nat }.

Section Relay.
  (** Its number, and for how many ways it has room. *)
  Variables (me room : nat).

  Definition is_way (w r : nat) (y : way) : bool := (way_wfr y =? w) && (way_robot y =? r).

  (** The message that it sends on. *)
  Definition sends_on (p : passing) : option upward :=
    if pid (message p) =? me then
      Some {| to_wfr := to_wfr (message p); of_call := of_call (message p); says := says (message p); pid := own p |}
    else None.

  Definition keeps (l : list way) (y : way) : list way :=
    if existsb (is_way (way_wfr y) (way_robot y)) l then
      map (fun z => if is_way (way_wfr y) (way_robot y) z && (way_call z <=? way_call y) then y else z) l
    else if length l <? room then l ++ [y] else l.

  Definition relay_step (l : list way) (p : passing) : list way * option upward :=
    (if pid (message p) =? me then
       keeps l {| way_wfr := to_wfr (message p); way_call := of_call (message p); way_robot := sender p;
                  came_from := from p |}
     else l, sends_on p).

  (** Who gets a RESB to robot [r] next, for the call [e] of WFR [w]. *)
  Definition goes_to (l : list way) (w e r : nat) : option hop :=
    option_map came_from (find (fun y => is_way w r y && (way_call y =? e)) l).
End Relay.
