(** The tie between the kernel and Notice.v: whatever the kernel's nodes have made of NOTICEs in
    generated/NoticeAnswers.v is in [hears], and what they have sent is what they say of themselves.

    The table has every state that NOTICEs of three senders with three hop counts lead a node to, under nine
    schemes, with the repaired conditions and without each of those that the theorem does not need. *)
From Coq Require Import List Bool Arith.
From Tautline Require Import Notice.
From Tautline.generated Require Import NoticeAnswers.
Import ListNotations.

Definition phase_of (k : nat) : phase := match k with 0 => Unaware | 1 => Waiting | 2 => Silent | _ => Forwarded end.
Definition node_of (x : nat * nat * nat) : node :=
  let '(k, p, h) := x in {| stage := phase_of k; parent := p; hops := h |}.

Definition eq_node (x y : node) : {x = y} + {x <> y}.
Proof. repeat decide equality. Defined.
Definition is_node (x y : node) : bool := if eq_node x y then true else false.

Definition is_heard (hears : node -> nat -> nat ->
  list node) (row : (nat * nat * nat) * (nat * nat) * (nat * nat * nat)) : bool :=
  let '(before, (s, h), after) := row in existsb (is_node (node_of after)) (hears (node_of before) s h).

(** A node that waits says its own hop count, and has forwarded then. *)
Definition is_sent (row : (nat * nat * nat) * ((nat * nat * nat) * nat)) : bool :=
  let '(before, (after, h)) := row in
  let x := node_of before in
  is_node (node_of after) (forwards x) && (h =? hops x) && match stage x with Waiting =>
    true | Unaware | Silent | Forwarded => false end.

(** What the kernel does without the freezing is not in [hears], but in [hears_thawed]: the table tells the two
    apart. *)
Theorem notice_answers_agree :
  forallb (is_heard hears) heard = true /\ forallb is_sent sent = true
  /\ forallb (fun row => negb (is_heard hears row)) heard_without_FrozenOnceForwarded = true
  /\ forallb (is_heard hears_thawed) heard_without_FrozenOnceForwarded = true
  /\ (length heard, length sent, length heard_without_FrozenOnceForwarded) = (423, 9, 63).
Proof. repeat split; vm_compute; reflexivity. Qed.
