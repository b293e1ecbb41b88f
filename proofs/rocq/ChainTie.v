(** The tie between the kernel and the chain's definitions: what the kernel has answered to every question about
    two neighbours, in generated/ChainAnswers.v, is what Lattice.v, Rule.v, Message.v and Unfolding.v say; and
    in no state that can be reached is another question asked. *)
From Coq Require Import ZArith NArith Lia Bool List Arith.
From Tautline Require Import Lattice Rule Team Contact Message Unfolding.
From Tautline.generated Require Import ChainAnswers.
Import ListNotations.
Local Open Scope Z_scope.

Definition span : Z := 2 * reach + 1.
Definition inside (o : Z * Z) : Prop := Z.abs (fst o) <= reach /\ Z.abs (snd o) <= reach.
Definition index (o : Z * Z) : Z := (snd o + reach) * span + (fst o + reach).
Definition numbers : list Z := map (fun i => Z.of_nat i - reach) (seq 0 (Z.to_nat span)).
Definition offsets : list (Z * Z) := list_prod numbers numbers.

Lemma in_numbers : forall x, Z.abs x <= reach -> In x numbers.
Proof.
  intros x H; apply in_map_iff; exists (Z.to_nat (x + reach)); unfold span in *; assert (reach = 5) by reflexivity.
  split; [lia|]. apply in_seq; lia.
Qed.

Lemma in_offsets : forall o, inside o -> In o offsets.
Proof. intros [x y] [X Y]; apply in_prod; now apply in_numbers. Qed.

Definition apart (a b : cell) : Z * Z := (fst b - fst a, snd b - snd a).

Lemma covers_apart : forall r a b a' b', apart a b = apart a' b' -> covers r a b = covers r a' b'.
Proof.
  intros r [x y] [u v] [x' y'] [u' v'] E; injection E; cbn; intros H K; unfold covers; cbn.
  replace (Z.abs (x - u)) with (Z.abs (x' - u')) by lia. now replace (Z.abs (y - v)) with (Z.abs (y' - v')) by lia.
Qed.

Definition at_bit (n : N) (k : Z) : bool := N.testbit n (Z.to_N k).

(** The circles. *)
Definition agree_covers (r : Z) (t : N) : bool :=
  forallb (fun o => Bool.eqb (covers r (0, 0) o) (at_bit t (index o))) offsets.

Theorem covers_tied : forall r t, agree_covers r t = true ->
  forall a b, inside (apart a b) -> covers r a b = at_bit t (index (apart a b)).
Proof.
  intros r t A a b I; unfold agree_covers in A; rewrite forallb_forall in A.
  specialize (A _ (in_offsets _ I)); apply eqb_prop in A; rewrite <- A.
  apply covers_apart; destruct a, b; unfold apart; cbn; f_equal; lia.
Qed.

Lemma circles_agree : agree_covers SAFE covers_SAFE = true /\ agree_covers COVERED covers_COVERED = true.
Proof. split; vm_compute; reflexivity. Qed.

Lemma reaches_agree :
  forallb (fun o => Bool.eqb (reaches COVERED (0, 0) o) (at_bit reaches_COVERED (index o))) offsets = true
  /\ forallb (fun o => Bool.eqb (neighbours (0, 0) o) (at_bit in_E_N (index o))) offsets = true.
Proof. split; vm_compute; reflexivity. Qed.

(** Steps and edges. *)
Lemma steps_agree : map (after (0, 0)) all_steps = leads.
Proof. reflexivity. Qed.
Lemma edges_agree : map (edge_of (0, 0)) all_sides = edges.
Proof. reflexivity. Qed.
Lemma reverse_agrees : map reverse all_steps = map (fun k => nth k all_steps Stay) back.
Proof. reflexivity. Qed.

(** The conditions. *)
Definition place (s : step) : Z :=
  match s with Cross East => 0 | Cross South => 1 | Cross West => 2 | Cross North => 3 | Stay => 4 end.

Definition question (own ahead : move) : Z :=
  (place (does own) * 5 + place (does ahead)) * 2 + (if known_open ahead then 1 else 0).

Definition answer (table : list N) (own ahead : move) : bool :=
  at_bit (nth (Z.to_nat (index (apart (from own) (from ahead)))) table 0%N) (question own ahead).

Definition origin (s : step) : move := {| from := (0, 0); does := s; known_open := false |}.
Definition placed (o : cell) (s : step) (k : bool) : move := {| from := o; does := s; known_open := k |}.

Definition agree_ahead (r : rule) (table : list N) : bool :=
  forallb (fun o => forallb (fun s => forallb (fun s' => forallb (fun k =>
    Bool.eqb (admits_ahead r (origin s) (placed o s' k)) (answer table (origin s) (placed o s' k)))
    [false; true]) all_steps) all_steps) offsets.

Lemma in_steps : forall s, In s all_steps.
Proof. intros [[]|]; cbn; auto 6. Qed.

Theorem ahead_tied : forall r table, agree_ahead r table = true ->
  forall own ahead, inside (apart (from own) (from ahead)) -> admits_ahead r own ahead = answer table own ahead.
Proof.
  intros r table A own ahead I; unfold agree_ahead in A.
  rewrite forallb_forall in A; specialize (A _ (in_offsets _ I)).
  rewrite forallb_forall in A; specialize (A _ (in_steps (does own))).
  rewrite forallb_forall in A; specialize (A _ (in_steps (does ahead))).
  rewrite forallb_forall in A; specialize (A (known_open ahead) ltac:(destruct (known_open ahead); cbn; auto)).
  apply eqb_prop in A.
  destruct own as [[x y] s k], ahead as [[u v] s' k']; unfold answer, question in *; cbn [from does known_open] in *.
  replace (apart (from (origin s)) (from (placed (apart (x, y) (u, v)) s' k'))) with (apart (x, y) (u, v)) in A
    by (unfold apart, origin, placed; cbn; f_equal; lia).
  cbn [does known_open origin placed] in A.
  rewrite <- A; unfold admits_ahead, to, is_sure; cbn [from does known_open origin placed].
  rewrite (covers_apart SAFE (after (u, v) s') (after (x, y) s) (after (apart (x, y) (u, v)) s') (after (0, 0) s)).
  rewrite (covers_apart COVERED (u, v) (after (x, y) s) (apart (x, y) (u, v)) (after (0, 0) s)). reflexivity.
  all: destruct s as [[]|], s' as [[]|]; unfold apart, after, beyond, offset; cbn [fst snd]; f_equal; lia.
Qed.

Definition agree_behind (r : rule) (t : N) : bool :=
  forallb (fun o => Bool.eqb (admits_behind r o (0, 0)) (at_bit t (index o))) offsets.

(** A robot enters a cell that up to 255 others occupy. *)
Definition agree_entry (r : rule) (t : N) : bool :=
  forallb (fun k => Bool.eqb (admits_entry r Leader k) (at_bit t (Z.of_nat k))
                    && Bool.eqb (admits_entry r Follower k) (at_bit t (256 + Z.of_nat k))) (seq 0 256).

Definition agree (r : rule) (ahead : list N) (behind entry : N) : bool :=
  agree_ahead r ahead && agree_behind r behind && agree_entry r entry.

Lemma relation_agrees :
  agree PUBLISHED ahead_PUBLISHED behind_PUBLISHED entry_PUBLISHED
  && agree REPAIRED ahead_REPAIRED behind_REPAIRED entry_REPAIRED
  && agree REEL ahead_REEL behind_REEL entry_REEL
  && agree without_SafeAhead ahead_without_SafeAhead behind_without_SafeAhead entry_without_SafeAhead
  && agree without_CoveredBehind ahead_without_CoveredBehind behind_without_CoveredBehind entry_without_CoveredBehind
  && agree without_UnsureAhead ahead_without_UnsureAhead behind_without_UnsureAhead entry_without_UnsureAhead
  && agree without_FullForFollower ahead_without_FullForFollower behind_without_FullForFollower
    entry_without_FullForFollower
  && agree without_FullForLeader ahead_without_FullForLeader behind_without_FullForLeader entry_without_FullForLeader
  = true.
Proof. vm_compute; reflexivity. Qed.

(** The bytes of messages. *)
Definition word (m : option (step * outcome)) : nat :=
  match m with
  | None => 0
  | Some (s, o) => 1 + 3 * Z.to_nat (place s) + match o with Arrived => 0 | Blocked => 1 | TookBack => 2 end
  end.

Lemma messages_agree : map (fun byte => word (decode (N.of_nat byte))) (seq 0 256) = words.
Proof. vm_compute; reflexivity. Qed.

(** Going on along a walk. *)
Lemma walks_agree :
  forallb (fun own => forallb (fun last => forallb (fun ahead =>
    Bool.eqb (goes_on own last ahead) (at_bit going_on (Z.of_nat (64 * own + 8 * last + ahead))))
    (seq 0 8)) (seq 0 8)) (seq 0 8) = true.
Proof. vm_compute; reflexivity. Qed.

(** Whatever a planner asks about neighbours in a state that can be reached is in the table. *)
Theorem every_question_is_in_the_table : forall N base wall st i, (2 <= N)%nat -> reachable N REPAIRED base wall st ->
  (S i < N)%nat -> inside (apart (pos st i) (pos st (S i)))
  /\ forall s, inside (apart (pos st i) (after (pos st (S i)) s)).
Proof.
  intros N base wall st i L R Li; destruct (CHAIN_1 N base wall st L R i Li) as [C _].
  apply E_C_is_the_block_and_four in C; unfold apart_x, apart_y in C.
  destruct (pos st i) as [x y], (pos st (S i)) as [u v]; cbn in C.
  unfold inside, apart; assert (reach = 5) as -> by reflexivity; cbn [fst snd].
  split; [lia|]. intros [[]|]; unfold after, beyond; cbn [fst snd offset]; lia.
Qed.

(** So the kernel's answers for REPAIRED are those of the relation, in every state that can be reached. *)
Theorem kernel_answers_as_the_relation : forall N base wall st pl i, (2 <= N)%nat ->
  reachable N REPAIRED base wall st -> (S i < N)%nat ->
  admits_ahead REPAIRED (as_move st pl i) (as_move st pl (S i)) = answer ahead_REPAIRED (as_move st pl i) (as_move st
    pl (S i)).
Proof.
  intros N base wall st pl i L R Li; apply ahead_tied; [vm_compute; reflexivity|].
  destruct (every_question_is_in_the_table N base wall st i L R Li) as [W _]; exact W.
Qed.

(** Every answer in the table is that of the definitions: of circles, steps and edges; of the relation, by eight
    rules; of messages; of walks. *)
Theorem chain_answers_agree :
  (agree_covers SAFE covers_SAFE = true /\ agree_covers COVERED covers_COVERED = true)
  /\ (map (after (0, 0)) all_steps = leads /\ map (edge_of (0, 0)) all_sides = edges
      /\ map reverse all_steps = map (fun k => nth k all_steps Stay) back)
  /\ (agree PUBLISHED ahead_PUBLISHED behind_PUBLISHED entry_PUBLISHED
      && agree REPAIRED ahead_REPAIRED behind_REPAIRED entry_REPAIRED
      && agree REEL ahead_REEL behind_REEL entry_REEL
      && agree without_SafeAhead ahead_without_SafeAhead behind_without_SafeAhead entry_without_SafeAhead
      && agree without_CoveredBehind ahead_without_CoveredBehind behind_without_CoveredBehind
        entry_without_CoveredBehind
      && agree without_UnsureAhead ahead_without_UnsureAhead behind_without_UnsureAhead entry_without_UnsureAhead
      && agree without_FullForFollower ahead_without_FullForFollower behind_without_FullForFollower
           entry_without_FullForFollower
      && agree without_FullForLeader ahead_without_FullForLeader behind_without_FullForLeader
        entry_without_FullForLeader
      = true)
  /\ map (fun byte => word (decode (N.of_nat byte))) (seq 0 256) = words.
Proof.
  exact (conj circles_agree (conj (conj steps_agree (conj edges_agree reverse_agrees)) (conj relation_agrees
    messages_agree))).
Qed.
