(** TAN-3: how a robot walks to a node that signals, and what it does where it hears nothing: for every number of tries and
    of times, all strengths and every order of what happens.

    [step] is the robot of kernel/src/tan/homing.rs with its counters, which fall, and its scan, which keeps the best
    direction so far. [goes_on] says the same in the words of the clause: by the list of what was heard in a scan, how often
    the node was asked in vain, and how often the robot went nearer to the node where it was last. *)
From Coq Require Import ZArith Lia List Bool Arith.
From Tautline Require Homing.
Import ListNotations.
Local Open Scope nat_scope.
Notation nav := Homing.nav.
Notation node := Homing.node.
Notation far := Homing.far.

Inductive input := Hears (v : nav) | Measures (heard : option Z) | Bumps | Waited.

(** What a robot does: it asks a node, points its antenna in a direction, walks in one, or is there or lost. *)
Inductive order := Ask (n : nat) | Point (h : nat) | Walk (h : nat) | There | Off.

Section Robot.
  (** The WFR; how strong a node is to be heard where it is, and how much stronger each time that the robot goes nearer
      to it; how often it does so and how often it asks at most; and the directions of a scan. *)
  Variables (goal : nat) (near closer : Z) (times tries turns : nat).

  Definition is_followed (hops n : nat) (v : nav) : bool :=
    (node v =? n) && (Homing.root v =? goal) && (S (far v) =? hops).

  (** ** The kernel's robot. *)
  Inductive stage := Asking (n : nat) | Scanning (v : nav) (at_ : nat) (best : option (Z * nat))
    | Walking (v : nav) (h : nat) (strongest : Z) | Arrived | Lost.
  Record robot := { hops : nat; tries_left : nat; times_left : nat; last : option (nat * nat); at_stage : stage }.

  Definition sets_out (parent h : nat) : robot :=
    {| hops := h; tries_left := tries - 1; times_left := times; last := None; at_stage := Asking parent |}.
  Definition now (x : robot) (s : stage) : robot :=
    {| hops := hops x; tries_left := tries_left x; times_left := times_left x; last := last x; at_stage := s |}.
  Definition is_last (x : robot) (n : nat) : bool := match last x with Some (l, _) => l =? n | None => false end.
  Definition is_near (x : robot) (n : nat) (s : Z) : bool :=
    (near + Z.of_nat (if is_last x n then times - times_left x else 0) * closer <=? s)%Z.
  Definition reach (x : robot) (v : nav) : robot :=
    {| hops := far v; tries_left := tries - 1; times_left := if is_last x (node v) then times_left x else times;
       last := Some (node v, far v); at_stage := if far v =? 0 then Arrived else Asking (Homing.above v) |}.
  Definition ask_again (x : robot) (n : nat) : robot :=
    match tries_left x, last x, times_left x with
    | S t, _, _ => {| hops := hops x; tries_left := t; times_left := times_left x; last := last x; at_stage := Asking n |}
    | O, Some (l, h), S t => if l =? n then now x Lost
        else {| hops := S h; tries_left := tries - 1; times_left := t; last := last x; at_stage := Asking l |}
    | O, _, _ => now x Lost
    end.

  Definition better (best : option (Z * nat)) (h : nat) (heard : option Z) : option (Z * nat) :=
    match heard, best with
    | Some s, None => Some (s, h)
    | Some s, Some (b, g) => if (b <? s)%Z then Some (s, h) else Some (b, g)
    | None, _ => best
    end.

  Definition step (x : robot) (i : input) : robot :=
    match i, at_stage x with
    | Hears v, Asking n => if is_followed (hops x) n v then now x (Scanning v 0 None) else x
    | Measures m, Scanning v a b =>
        let b := better b a m in
        if S a <? turns then now x (Scanning v (S a) b)
        else match b with
             | Some (s, h) => if is_near x (node v) s then reach x v else now x (Walking v h s)
             | None => ask_again x (node v)
             end
    | Measures (Some s), Walking v h b =>
        if is_near x (node v) s then reach x v
        else if (b <=? s)%Z then now x (Walking v h s) else now x (Scanning v 0 None)
    | Measures None, Walking v _ _ => ask_again x (node v)
    | Bumps, Walking v _ _ => now x (Scanning v 0 None)
    | Waited, Asking n => ask_again x n
    | _, _ => x
    end.

  Definition ordered (x : robot) : order :=
    match at_stage x with
    | Asking n => Ask n | Scanning _ a _ => Point a | Walking _ h _ => Walk h | Arrived => There | Lost => Off
    end.

  (** ** The same in the words of the clause. *)
  Inductive doing := Waits | Turns (v : nav) (heard : list (option Z)) | Goes (v : nav) (h : nat) (strongest : Z) | IsThere | IsLost.
  (** Whom it has asked, and its own hops; how often in vain; where it was last, with that node's hops, and how often it has gone
      nearer to it since. *)
  Record way := { asked : nat; own : nat; in_vain : nat; was : option (nat * nat * nat); does : doing }.

  Definition begins (parent h : nat) : way := {| asked := parent; own := h; in_vain := 0; was := None; does := Waits |}.
  Definition and_does (w : way) (d : doing) : way :=
    {| asked := asked w; own := own w; in_vain := in_vain w; was := was w; does := d |}.
  Definition nearer (w : way) (n : nat) : nat := match was w with Some (l, _, k) => if l =? n then k else 0 | None => 0 end.
  (** How strong it hears the node that it has asked where it is. *)
  Definition due (w : way) : Z := (near + Z.of_nat (nearer w (asked w)) * closer)%Z.
  Definition comes (w : way) (v : nav) : way :=
    {| asked := Homing.above v; own := far v; in_vain := 0; was := Some (asked w, far v, nearer w (asked w));
       does := if far v =? 0 then IsThere else Waits |}.
  (** In vain: it asks again; or the node where it was last, to which it goes nearer; or is lost. *)
  Definition fails (w : way) : way :=
    if S (in_vain w) <? tries
    then {| asked := asked w; own := own w; in_vain := S (in_vain w); was := was w; does := Waits |}
    else match was w with
         | Some (l, h, k) => if negb (l =? asked w) && (k <? times)
             then {| asked := l; own := S h; in_vain := 0; was := Some (l, h, S k); does := Waits |}
             else and_does w IsLost
         | None => and_does w IsLost
         end.
  (** The first of the strongest directions, and how strong it is. *)
  Definition strongest (heard : list (option Z)) : option (Z * nat) :=
    let is_strongest h := match nth h heard None with
      | Some s => forallb (fun m => match m with Some t => (t <=? s)%Z | None => true end) heard | None => false end in
    match find is_strongest (seq 0 (length heard)) with
    | Some h => option_map (fun s => (s, h)) (nth h heard None)
    | None => None
    end.

  Definition goes_on (w : way) (i : input) : way :=
    match i, does w with
    | Hears v, Waits => if is_followed (own w) (asked w) v then and_does w (Turns v []) else w
    | Measures m, Turns v heard =>
        let heard := heard ++ [m] in
        if length heard <? turns then and_does w (Turns v heard)
        else match strongest heard with
             | Some (s, h) => if (due w <=? s)%Z then comes w v else and_does w (Goes v h s)
             | None => fails w
             end
    | Measures (Some s), Goes v h b =>
        if (due w <=? s)%Z then comes w v else and_does w (if (b <=? s)%Z then Goes v h s else Turns v [])
    | Measures None, Goes _ _ _ => fails w
    | Bumps, Goes v _ _ => and_does w (Turns v [])
    | Waited, Waits => fails w
    | _, _ => w
    end.

  Definition is_due (w : way) : order :=
    match does w with
    | Waits => Ask (asked w) | Turns _ heard => Point (length heard) | Goes _ h _ => Walk h | IsThere => There | IsLost => Off
    end.

  (** ** They agree. *)
  Lemma strongest_spec : forall heard s h, strongest heard = Some (s, h) <->
    nth_error heard h = Some (Some s)
    /\ forall g t, nth_error heard g = Some (Some t) -> (t <= s)%Z /\ (g < h -> (t < s)%Z).
  Proof.
    intros heard s h; unfold strongest.
    set (p := fun h => match nth h heard None with
      | Some s => forallb (fun m => match m with Some t => (t <=? s)%Z | None => true end) heard | None => false end).
    assert (forall g, p g = true <-> exists s, nth_error heard g = Some (Some s)
      /\ forall k t, nth_error heard k = Some (Some t) -> (t <= s)%Z) as P.
    { intros g; unfold p; destruct (nth_error heard g) as [m|] eqn:E.
      - rewrite (nth_error_nth heard g None E). destruct m as [b|]; [|split; [discriminate | intros [u [X _]]; discriminate]].
        rewrite forallb_forall; split.
        + intros F; exists b; split; [reflexivity|]. intros k t H; apply nth_error_In, F in H; now apply Z.leb_le.
        + intros [u [X F]] [t|] I; [|reflexivity]. injection X as <-. apply In_nth_error in I; destruct I as [k I].
          apply Z.leb_le; eapply F; eauto.
      - rewrite nth_overflow by (now apply nth_error_None). split; [discriminate | intros [u [X _]]; discriminate]. }
    assert (forall l, match find p l with Some g => p g = true | None => True end) as Fp.
    { induction l as [|g l IH]; cbn; [exact I|]. destruct (p g) eqn:E; assumption. }
    assert (forall n g b, find p (seq b n) = Some g -> b <= g < b + n /\ forall k, b <= k < g -> p k = false) as Ff.
    { induction n as [|n IH]; intros g b E; cbn in E; [discriminate|]. destruct (p b) eqn:Pb.
      - injection E as <-; split; [lia | intros k L; lia].
      - apply IH in E; destruct E as [L N]; split; [lia|]. intros k Lk; destruct (Nat.eq_dec k b) as [->|]; [assumption | apply N; lia]. }
    assert (find p (seq 0 (length heard)) = None -> forall g, g < length heard -> p g = false) as Fn.
    { intros E g L; eapply find_none; eauto. apply in_seq; lia. }
    split.
    - intros E; destruct (find p (seq 0 (length heard))) as [g|] eqn:F; [|discriminate].
      pose proof (Fp (seq 0 (length heard))) as G; rewrite F in G. apply P in G; destruct G as [b [G M]].
      rewrite (nth_error_nth heard g None G) in E; cbn in E; injection E as <- <-. split; [exact G|].
      intros k t H; split; [eauto|]. intros L. apply Ff in F; destruct F as [_ F].
      destruct (Z.eq_dec t b) as [->|]; [|apply M in H; lia].
      assert (p k = true) as X; [|rewrite (F k) in X by lia; discriminate]. apply P; exists b; auto.
    - intros [H M]. assert (p h = true) as Ph by (apply P; exists s; split; [exact H | intros k t X; now apply M in X]).
      assert (h < length heard) as L by (apply nth_error_Some; congruence).
      destruct (find p (seq 0 (length heard))) as [g|] eqn:F; [|rewrite (Fn eq_refl h L) in Ph; discriminate].
      pose proof (Fp (seq 0 (length heard))) as G; rewrite F in G. apply P in G; destruct G as [b [G N]].
      apply Ff in F; destruct F as [_ F].
      assert (b = s) as -> by (apply M in G as X; apply N in H as Y; lia).
      rewrite (nth_error_nth heard g None G); cbn. do 2 f_equal.
      destruct (Nat.lt_trichotomy g h) as [L'|[E|L']]; [apply M in G as X; lia | exact E |].
      rewrite (F h) in Ph by lia; discriminate.
  Qed.

  Lemma strongest_none : forall heard, strongest heard = None <-> forall m, In m heard -> m = None.
  Proof.
    intros heard; split.
    - intros E m I; destruct m as [t|]; [exfalso|reflexivity].
      assert (forall l : list (option Z), (exists t, In (Some t) l) -> exists g s, nth_error l g = Some (Some s)
        /\ forall k t, nth_error l k = Some (Some t) -> (t <= s)%Z /\ (k < g -> (t < s)%Z)) as Max.
      { clear. induction l as [|m l IH]; intros [t I]; [destruct I|].
        assert ((exists t, In (Some t) l) \/ forall k t, nth_error l k <> Some (Some t)) as [H|H].
        { clear. induction l as [|[t|] l IH]; [right; intros [|k] t; discriminate | left; exists t; now left|].
          destruct IH as [[t I]|N]; [left; exists t; now right | right; intros [|k] t; cbn; [discriminate | apply N]]. }
        - destruct (IH H) as [g [s [G M]]]. destruct m as [u|]; [destruct (Z_le_gt_dec s u) as [L|L]|].
          + exists 0, u; split; [reflexivity|]. intros [|k] t' E; cbn in E; [injection E as <-; lia|]. apply M in E; lia.
          + exists (S g), s; split; [exact G|]. intros [|k] t' E; cbn in E; [injection E as <-; lia|]. apply M in E; lia.
          + exists (S g), s; split; [exact G|]. intros [|k] t' E; cbn in E; [discriminate|]. apply M in E; lia.
        - destruct I as [->|I]; [|apply In_nth_error in I; destruct I as [k I]; exfalso; now apply (H k t)].
          exists 0, t; split; [reflexivity|]. intros [|k] t' E; cbn in E; [injection E as <-; lia | now apply H in E]. }
      destruct (Max heard) as [g [s G]]; [eauto|]. apply strongest_spec in G; congruence.
    - intros H; destruct (strongest heard) as [[s h]|] eqn:E; [exfalso|reflexivity]. apply strongest_spec in E.
      destruct E as [E _]; apply nth_error_In, H in E; discriminate.
  Qed.

  (** One direction more. *)
  Lemma strongest_more : forall heard m, strongest (heard ++ [m]) = better (strongest heard) (length heard) m.
  Proof.
    intros heard m.
    assert (forall k, nth_error (heard ++ [m]) k = if k <? length heard then nth_error heard k else
      if k =? length heard then Some m else None) as Nth.
    { intros k; destruct (Nat.ltb_spec k (length heard)); [now rewrite nth_error_app1|]. rewrite nth_error_app2 by assumption.
      destruct (Nat.eqb_spec k (length heard)) as [->|]; [now rewrite Nat.sub_diag|].
      apply nth_error_None; cbn; lia. }
    destruct (strongest heard) as [[s h]|] eqn:E.
    - apply strongest_spec in E; destruct E as [H M]. assert (h < length heard) as L by (apply nth_error_Some; congruence).
      destruct m as [t|]; cbn [better]; [destruct (Z.ltb_spec s t) as [Lt|Ge]|]; apply strongest_spec; rewrite Nth.
      + rewrite (proj2 (Nat.ltb_ge _ _)) by lia. rewrite Nat.eqb_refl; split; [reflexivity|]. intros k u; rewrite Nth.
        destruct (Nat.ltb_spec k (length heard)); [intros X; apply M in X; lia|].
        destruct (Nat.eqb_spec k (length heard)); [intros X; injection X as <-; lia | discriminate].
      + rewrite (proj2 (Nat.ltb_lt _ _) L); split; [exact H|]. intros k u; rewrite Nth.
        destruct (Nat.ltb_spec k (length heard)); [apply M|].
        destruct (Nat.eqb_spec k (length heard)); [intros X; injection X as <-; lia | discriminate].
      + rewrite (proj2 (Nat.ltb_lt _ _) L); split; [exact H|]. intros k u; rewrite Nth.
        destruct (Nat.ltb_spec k (length heard)); [apply M|]. destruct (_ =? _); discriminate.
    - pose proof (proj1 (strongest_none heard) E) as N. destruct m as [t|]; cbn.
      + apply strongest_spec; rewrite Nth, (proj2 (Nat.ltb_ge _ _)) by lia. rewrite Nat.eqb_refl; split; [reflexivity|].
        intros k u; rewrite Nth. destruct (Nat.ltb_spec k (length heard)); [intros X; apply nth_error_In, N in X; discriminate|].
        destruct (Nat.eqb_spec k (length heard)); [intros X; injection X as <-; lia | discriminate].
      + apply strongest_none; intros m I; apply in_app_or in I; destruct I as [I|[<-|[]]]; auto.
  Qed.

  Hypothesis some_tries : 1 <= tries.
  Hypothesis some_turns : 1 <= turns.

  Definition same_stage (w : way) (s : stage) : Prop :=
    match s, does w with
    | Asking n, Waits => n = asked w
    | Scanning v a b, Turns u heard => v = u /\ node v = asked w /\ a = length heard /\ b = strongest heard
    | Walking v h b, Goes u g s => v = u /\ node v = asked w /\ h = g /\ b = s
    | Arrived, IsThere | Lost, IsLost => True
    | _, _ => False
    end.
  Record same (x : robot) (w : way) : Prop := {
    same_hops : hops x = own w;
    same_tries : tries_left x + S (in_vain w) = tries;
    same_last : last x = option_map fst (was w);
    same_times : match was w with Some (_, k) => times_left x + k = times | None => times_left x = times end;
    same_does : same_stage w (at_stage x);
  }.

  Lemma same_near : forall x w v s, same x w -> node v = asked w -> is_near x (node v) s = (due w <=? s)%Z.
  Proof.
    intros x w v s [_ _ L T _] E; unfold is_near, due, is_last, nearer; rewrite E, L. do 3 f_equal.
    destruct (was w) as [[[l h] k]|]; cbn; [|reflexivity]. destruct (l =? asked w); lia.
  Qed.
  Lemma same_fails : forall x w, same x w -> same (ask_again x (asked w)) (fails w).
  Proof.
    intros x w [H T L M _]; unfold ask_again, fails. destruct (Nat.ltb_spec (S (in_vain w)) tries) as [Lt|Ge].
    - destruct (tries_left x) as [|t] eqn:Et; [lia|]. constructor; cbn; auto; lia.
    - destruct (tries_left x) as [|t] eqn:Et; [|lia]. rewrite L.
      destruct (was w) as [[[l h] k]|] eqn:W; cbn [option_map fst].
      + destruct (Nat.eqb_spec l (asked w)) as [->|D]; cbn [negb andb].
        * destruct (times_left x) eqn:Ex; constructor; cbn; rewrite ?W, ?Et, ?Ex; auto; lia.
        * destruct (Nat.ltb_spec k times), (times_left x) eqn:Ex; try lia.
          -- constructor; cbn; rewrite ?L, ?W; auto; lia.
          -- constructor; cbn; rewrite ?L, ?W, ?Et, ?Ex; auto; lia.
      + destruct (times_left x) eqn:Ex; constructor; cbn; rewrite ?W, ?Et, ?Ex; auto; lia.
  Qed.
  Lemma same_comes : forall x w v, same x w -> node v = asked w -> same (reach x v) (comes w v).
  Proof.
    intros x w v [H T L M _] E; unfold reach, comes; constructor; cbn; auto; [lia | now rewrite E | |].
    - unfold is_last, nearer; rewrite L, E. destruct (was w) as [[[l h] k]|]; cbn; [|lia]. destruct (l =? asked w); lia.
    - destruct (far v =? 0); cbn; auto.
  Qed.
  Lemma same_now : forall x w s d, same x w -> same_stage (and_does w d) s -> same (now x s) (and_does w d).
  Proof. intros x w s d [H T L M _] S; constructor; auto. Qed.

  Lemma same_step : forall x w i, same x w -> same (step x i) (goes_on w i).
  Proof.
    intros x w i S; pose proof (same_does _ _ S) as D; unfold same_stage in D. unfold step, goes_on.
    destruct (at_stage x) as [n|v a b|v h b| |], (does w) as [|u heard|u g s| |]; try contradiction; destruct i as [z|[m|]| |]; auto.
    - subst n. rewrite (same_hops _ _ S). destruct (is_followed (own w) (asked w) z) eqn:F; [|exact S].
      apply same_now; [exact S|]. unfold is_followed in F; rewrite !andb_true_iff, !Nat.eqb_eq in F. cbn; intuition.
    - subst n; now apply same_fails.
    - destruct D as [<- [E [-> ->]]]. rewrite app_length; cbn [length]; rewrite Nat.add_1_r.
      rewrite <- strongest_more. destruct (Datatypes.S (length heard) <? turns) eqn:Lt.
      + apply same_now; [exact S|]. cbn; rewrite app_length; cbn; intuition lia.
      + destruct (strongest (heard ++ [Some m])) as [[t g]|]; [|rewrite E; now apply same_fails].
        rewrite (same_near x w v t S E). destruct (due w <=? t)%Z; [now apply same_comes | apply same_now; cbn; auto].
    - destruct D as [<- [E [-> ->]]]. rewrite app_length; cbn [length]; rewrite Nat.add_1_r.
      rewrite <- strongest_more. destruct (Datatypes.S (length heard) <? turns) eqn:Lt.
      + apply same_now; [exact S|]. cbn; rewrite app_length; cbn; intuition lia.
      + destruct (strongest (heard ++ [None])) as [[t g]|]; [|rewrite E; now apply same_fails].
        rewrite (same_near x w v t S E). destruct (due w <=? t)%Z; [now apply same_comes | apply same_now; cbn; auto].
    - destruct D as [<- [E [-> ->]]]. rewrite (same_near x w v m S E). destruct (due w <=? m)%Z; [now apply same_comes|].
      destruct (s <=? m)%Z; apply same_now; cbn; auto.
    - destruct D as [<- [E [-> ->]]]. rewrite E; now apply same_fails.
    - destruct D as [<- [E [-> ->]]]. apply same_now; cbn; auto.
  Qed.

  Lemma same_always : forall l x w, same x w -> same (fold_left step l x) (fold_left goes_on l w).
  Proof. induction l as [|i l IH]; intros x w S; cbn; [exact S | now apply IH, same_step]. Qed.
End Robot.

(** Whatever happens to a robot, it does what is due. *)
Theorem TAN_3 : forall goal near closer times tries turns, 1 <= tries -> 1 <= turns -> forall parent h l,
  let x := fold_left (step goal near closer times tries turns) l (sets_out times tries parent h) in
  let w := fold_left (goes_on goal near closer times tries turns) l (begins parent h) in
  ordered x = is_due w /\ hops x = own w.
Proof.
  intros goal near closer times tries turns T U parent h l x w.
  assert (same times tries x w) as [H _ _ _ D].
  { apply same_always; [exact T | exact U|]. constructor; cbn; auto; lia. }
  split; [|exact H]. unfold same_stage in D; unfold ordered, is_due.
  destruct (at_stage x), (does w); try contradiction; try reflexivity; intuition congruence.
Qed.

(** The direction in which it walks is the first of the strongest ones. *)
Theorem the_first_of_the_strongest : forall heard s h, strongest heard = Some (s, h) <->
  nth_error heard h = Some (Some s)
  /\ forall g t, nth_error heard g = Some (Some t) -> (t <= s)%Z /\ (g < h -> (t < s)%Z).
Proof. exact strongest_spec. Qed.

(** A robot that asks once more, or goes nearer once more, than it may does otherwise. *)
Theorem other_numbers_break_TAN_3 :
  (exists l, ordered (fold_left (step 0 100%Z 10%Z 1 3 24) l (sets_out 1 3 2 3))
     <> is_due (fold_left (goes_on 0 100%Z 10%Z 1 2 24) l (begins 2 3)))
  /\ exists l, ordered (fold_left (step 0 100%Z 10%Z 1 1 1) l (sets_out 1 1 2 3))
     <> is_due (fold_left (goes_on 0 100%Z 10%Z 0 1 1) l (begins 2 3)).
Proof.
  split; [exists [Waited; Waited]; discriminate|].
  exists [Hears {| Homing.root := 0; Homing.node := 2; Homing.far := 2; Homing.above := 1 |}; Measures (Some 100%Z); Waited].
  discriminate.
Qed.
