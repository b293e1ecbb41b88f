(** CHAIN-3: during every team move, at whatever speeds, the centres of neighbours in the chain stay within
    r_cov.

    For every number of robots, every layout and every order of preference, under every rule that has SafeAhead:
    so also as published. A robot is at any moment somewhere on the straight way between the centres of two
    cells. *)
From Coq Require Import ZArith QArith Lia Bool List Arith.
From Tautline Require Import Lattice Rule Team Contact Plane.
Import ListNotations.
Local Open Scope nat_scope.

(** Neighbours in two placements: each corner of the parallelogram of offsets is within r_cov. *)
Definition corners (p q p' q' : cell) : Prop :=
  reaches COVERED p p' = true /\ reaches COVERED p q' = true /\ reaches COVERED q p' = true /\
    reaches COVERED q q' = true.

Lemma reaches_near : forall a b, (apart_x a b <= 2)%Z -> (apart_y a b <= 2)%Z -> (apart_x a b + apart_y a b <= 3)%Z ->
  reaches COVERED a b = true.
Proof. intros a b; unfold reaches, COVERED, apart_x, apart_y; rewrite Z.leb_le; nia. Qed.

Lemma step_near : forall c s, (apart_x c (after c s) + apart_y c (after c s) <= 1)%Z.
Proof. intros [x y] [[]|]; unfold apart_x, apart_y; cbn; lia. Qed.

(** The pair lemma: SafeAhead alone is enough. *)
Lemma pair_coverage : forall r own ahead,
  safe_ahead r = true -> reaches COVERED (from own) (from ahead) = true -> admits_ahead r own ahead = true ->
  corners (from own) (to own) (from ahead) (to ahead).
Proof.
  intros r own ahead Hs R A; unfold admits_ahead in A; rewrite Hs in A; cbn in A.
  apply andb_true_iff in A; destruct A as [A _]; rewrite covers_sym in A; apply E_S_is_the_block in A.
  pose proof (step_near (from own) (does own)) as S; pose proof (step_near (from ahead) (does ahead)) as S'.
  fold (to own) in S; fold (to ahead) in S'.
  repeat split; auto; apply reaches_near; unfold apart_x, apart_y in *; lia.
Qed.

(** Each robot is somewhere on the straight way between its two cells: their centres are within r_cov, 4 r_cov^2
    = 26. *)
Lemma on_the_way : forall p q p' q' s t, corners p q p' q' -> (0 <= s <= 1)%Q -> (0 <= t <= 1)%Q ->
  (norm2 (minus (between s (centre p) (centre q)) (between t (centre p') (centre q'))) <= 26 # 4)%Q.
Proof.
  assert (forall a b, reaches COVERED a b = true -> (norm2 (minus (centre a) (centre b)) <= 26 # 4)%Q) as R.
  { intros a b H; apply norm2_centres; unfold reaches, COVERED in H; rewrite Z.leb_le in H; nia. }
  intros p q p' q' s t [A [B [C D]]] S T; apply corners_decide; auto.
Qed.

Section Coverage.
  Variable N : nat.
  Variable rl : rule.
  Variable base : cell.
  Variable wall : edge -> bool.
  Hypothesis two_robots : 2 <= N.
  Hypothesis has_safe_ahead : safe_ahead rl = true.

  Definition covered (p : team) : Prop := forall i, S i < N -> reaches COVERED (p i) (p (S i)) = true.
  Definition corners_of (p q : team) : Prop := forall i, S i < N -> corners (p i) (q i) (p (S i)) (q (S i)).

  Lemma corners_moved : forall st pl i, corners (pos st i) (planned st pl i) (pos st (S i)) (planned st pl (S i)) ->
    corners (pos st i) (moved wall (pos st) pl i) (pos st (S i)) (moved wall (pos st) pl (S i)).
  Proof.
    intros st pl i [A [B [C D]]].
    destruct (moved_or_not wall st pl i) as [-> | ->], (moved_or_not wall st pl (S i)) as [-> | ->]; repeat split; auto.
  Qed.

  Theorem covered_always : forall past st, run N rl base wall past st ->
    linked corners_of past /\ Forall (fun p => covered p) past.
  Proof.
    intros past st R.
    destruct (composition N rl base wall covered corners_of) with (past := past) (st := st)
      as [_ [_ [L [_ F]]]]; auto; try lia.
    - intros p q S C i L; rewrite <- !S by lia; auto.
    - intros p p' q q' S S' C i L; rewrite <- !S, <- !S' by lia; auto.
    - intros p q C i L; destruct (C i L) as [A [B [D E]]]; repeat split; auto.
    - intros i _; unfold reaches; rewrite !Z.sub_diag; reflexivity.
    - intros s pl K _ C A.
      assert (corners_of (pos s) (moved wall (pos s) pl)) as X.
      { intros i L; apply corners_moved.
        apply (pair_coverage rl (as_move s pl i) (as_move s pl (S i))); auto.
        - now apply C.
        - now apply admitted_ahead with (N := N) (base := base). }
      split; [|exact X]. intros i L; apply X; exact L.
    - split; [exact L|]. eapply Forall_impl; [|exact F]. intros p [_ C]; exact C.
  Qed.
End Coverage.

(** During every team move, an advance or a backtrack, the centres of neighbours stay within r_cov: whatever
    part [s], [t] of their straight ways the two have gone at some moment. It needs SafeAhead alone, so it holds
    as published. *)
Theorem CHAIN_3 : forall N rl base wall past after_ before_ st,
  2 <= N -> safe_ahead rl = true -> run N rl base wall (after_ :: before_ :: past) st ->
  forall i s t, S i < N -> (0 <= s <= 1)%Q -> (0 <= t <= 1)%Q ->
  (norm2 (minus (between s (centre (before_ i)) (centre (after_ i)))
                (between t (centre (before_ (S i))) (centre (after_ (S i))))) <= 26 # 4)%Q.
Proof.
  intros N rl base wall past p q st L H R i s t Li S T.
  destruct (covered_always _ _ _ _ L H _ _ R) as [X _]; cbn in X.
  apply on_the_way; auto.
Qed.

(** Also on the way to a wall and back: the corners are those of where the two planned to be. *)
Theorem CHAIN_3_towards_a_wall : forall N rl base wall st pl,
  2 <= N -> safe_ahead rl = true -> reachable N rl base wall st -> admitted N rl base st pl = true ->
  forall i s t, S i < N -> (0 <= s <= 1)%Q -> (0 <= t <= 1)%Q ->
  (norm2 (minus (between s (centre (pos st i)) (centre (planned st pl i)))
                (between t (centre (pos st (S i))) (centre (planned st pl (S i))))) <= 26 # 4)%Q.
Proof.
  intros N rl base wall st pl L H [past R] A i s t Li S T.
  destruct (covered_always _ _ _ _ L H _ _ R) as [_ F].
  apply on_the_way; auto.
  apply (pair_coverage rl (as_move st pl i) (as_move st pl (Datatypes.S i))); auto.
  - destruct R; inversion F as [|? ? X _]; exact (X i Li).
  - now apply admitted_ahead with (N := N) (base := base).
Qed.
